"""``$(eval)``: Python's own values, and nothing beyond plain expressions."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from ros2_standin.errors import UserError
from ros2_standin.launch.safe_eval import safe_eval

_LEAVES = st.integers(-9, 9).map(str) | st.floats(-9, 9).map(repr) | st.sampled_from(["True", "False"])
_EXPRESSIONS = st.recursive(
    _LEAVES,
    lambda inner: st.tuples(
        inner, st.sampled_from(["+", "-", "*", "/", "//", "%", "<", ">=", "==", "and", "or", "if 2 else"]), inner
    ).map(lambda parts: f"({' '.join(parts)})"),
    max_leaves=8,
)


@given(_EXPRESSIONS)
def test_equals_python(expression: str) -> None:
    try:
        expected = eval(expression)
    except ArithmeticError:
        with pytest.raises(UserError):
            safe_eval(expression)
        return
    assert repr(safe_eval(expression)) == repr(expected)  # of no number, too


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("'sim' in ['sim', 'real']", True),
        ("'a' + 'b' if 1 < 2 < 3 else 'c'", "ab"),
        ("round(math.cos(0) + sin(0) + pi)", 4),
        ("'A B'.lower().split(' ')[1]", "b"),
        ("max(1, 2) ** 3", 8),
        ("not true", False),
    ],
)
def test_functions_and_texts(expression: str, value: object) -> None:
    assert safe_eval(expression) == value


@pytest.mark.parametrize(
    "expression",
    [
        "__import__('os').system('true')", "().__class__", "'a'.__class__", "open('/etc/passwd')", "lambda: 1", "print",
        "[i for i in (1, 2)]", "f'{1}'", "'{0.__class__}'.format(1)", "x", "1 +", "", "10 ** 10 ** 10", "'a' * 10 ** 9",
        "[0] * 9 ** 9", "9 ** 9 * [0]", "'%999999999d' % 1", "math.os", "factorial(10 ** 9)", "abs", "1 / 0", "'a' + 1",
        "(" * 5000 + ")" * 5000,
    ],
)  # fmt: skip
def test_anything_else_is_refused(expression: str) -> None:
    with pytest.raises(UserError):
        safe_eval(expression)
