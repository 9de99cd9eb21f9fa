"""Short names of parametrised cases."""


def label(value: object) -> str:
    """The name of what has one, else the beginning of how it is written."""
    return str(getattr(value, "name", repr(value)))[:16]
