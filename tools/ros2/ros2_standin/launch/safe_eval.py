"""``$(eval ...)``: a Python expression of plain values, evaluated without ``eval``."""

from __future__ import annotations

import ast
import math
import operator
from collections.abc import Callable
from types import MappingProxyType

from ros2_standin.errors import UserError

_LARGEST = 10_000
"""Longest text or list, and largest exponent, that an expression may make."""

_SLOW = ("comb", "factorial", "perm")
"""Functions of ``math`` whose result grows beyond any use."""

_BINARY: MappingProxyType[type[ast.operator], Callable] = MappingProxyType(
    {
        ast.Add: operator.add,
        ast.Sub: operator.sub,
        ast.Mult: operator.mul,
        ast.Div: operator.truediv,
        ast.FloorDiv: operator.floordiv,
        ast.Mod: operator.mod,
        ast.Pow: operator.pow,
    }
)
_UNARY: MappingProxyType[type[ast.unaryop], Callable] = MappingProxyType(
    {ast.USub: operator.neg, ast.UAdd: operator.pos, ast.Not: operator.not_}
)
_COMPARE: MappingProxyType[type[ast.cmpop], Callable] = MappingProxyType(
    {
        ast.Eq: operator.eq,
        ast.NotEq: operator.ne,
        ast.Lt: operator.lt,
        ast.LtE: operator.le,
        ast.Gt: operator.gt,
        ast.GtE: operator.ge,
        ast.In: lambda item, group: item in group,
        ast.NotIn: lambda item, group: item not in group,
    }
)
_NAMES: MappingProxyType[str, object] = MappingProxyType(
    {
        **{name: value for name, value in vars(math).items() if not name.startswith("_") and name not in _SLOW},
        **{function.__name__: function for function in (abs, bool, float, int, len, max, min, round, str, sum)},
        "true": True,
        "false": False,
    }
)
_METHODS = frozenset(
    {"endswith", "isdigit", "join", "lower", "lstrip", "removeprefix", "removesuffix", "replace", "rstrip", "split",
     "startswith", "strip", "title", "upper"}
)  # fmt: skip


def safe_eval(expression: str) -> object:
    """Value of an expression of numbers, texts, lists, arithmetic, comparisons and a few functions.

    The names are those of ``math`` and of the plain builtins; texts have their usual methods.

    Raises:
        UserError: not such an expression, or it has no value.
    """
    try:
        value = _value(ast.parse(expression.strip(), mode="eval").body)
    except (ArithmeticError, LookupError, TypeError, ValueError, SyntaxError, RecursionError, MemoryError) as error:
        raise UserError(f"the expression {expression!r} has no value: {error}") from error
    if callable(value):
        raise UserError(f"the expression {expression!r} is a function, not a value")
    return value


def _value(node: ast.expr) -> object:
    match node:
        case ast.Constant(value=bool() | int() | float() | str() | None as value):
            return value
        case ast.List(elts=items) | ast.Tuple(elts=items):
            return [_value(item) for item in items]
        case ast.Name(id=name) if name in _NAMES:
            return _NAMES[name]
        case ast.Attribute(value=ast.Name(id="math"), attr=name) if name in _NAMES and name in vars(math):
            return _NAMES[name]
        case ast.UnaryOp(op=sign, operand=operand) if type(sign) in _UNARY:
            return _UNARY[type(sign)](_value(operand))
        case ast.BinOp(left=left, op=sign, right=right) if type(sign) in _BINARY:
            return _bounded(type(sign), _value(left), _value(right))
        case ast.BoolOp(op=sign, values=values):
            return _either(values) if isinstance(sign, ast.Or) else _both(values)
        case ast.Compare(left=left, ops=signs, comparators=others) if all(type(sign) in _COMPARE for sign in signs):
            values = [_value(item) for item in (left, *others)]
            return all(_COMPARE[type(sign)](values[i], values[i + 1]) for i, sign in enumerate(signs))
        case ast.IfExp(test=test, body=body, orelse=orelse):
            return _value(body if _value(test) else orelse)
        case ast.Subscript(value=value, slice=index) if not isinstance(index, ast.Slice):
            return _value(value)[_value(index)]
        case ast.Call(func=ast.Attribute(value=value, attr=name), args=args, keywords=[]) if name in _METHODS:
            text = _value(value)
            if not isinstance(text, str):
                raise TypeError(f"{text!r} is no text, and has no {name}")
            return getattr(text, name)(*map(_value, args))
        case ast.Call(func=function, args=args, keywords=[]):
            return _value(function)(*map(_value, args))
    raise UserError(f"the expression has {ast.unparse(node)!r}, which is not allowed in $(eval)")


def _either(values: list[ast.expr]) -> object:
    for node in values:
        if found := _value(node):
            return found
    return found


def _both(values: list[ast.expr]) -> object:
    for node in values:
        if not (found := _value(node)):
            return found
    return found


def _bounded(sign: type[ast.operator], left: object, right: object) -> object:
    """The operation, unless its result would be huge."""
    if sign is ast.Pow and max(abs(left), abs(right)) > _LARGEST:
        raise ValueError(f"{left} ** {right} is too large")
    if sign is ast.Mult:
        factors = [len(item) if isinstance(item, str | list) else item for item in (left, right)]
        if factors != [left, right] and math.prod(factors) > _LARGEST:
            raise ValueError("the product is too long")
    if sign is ast.Mod and not all(isinstance(item, int | float) for item in (left, right)):
        raise TypeError("% is for numbers")
    return _BINARY[sign](left, right)
