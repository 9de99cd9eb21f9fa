"""Direct dependencies with some versions changed, for `make check-old`."""

import re


def with_versions(requirements: str, versions: str) -> str:
    """Return the pins of ``requirements`` with the versions in ``versions``, without those that it excludes.

    Raises:
        ValueError: ``versions`` names a package that is not required.
    """
    pins = dict(re.findall(r"^([a-z0-9-]+)==(\S+)$", requirements, re.MULTILINE))
    changed = dict(re.findall(r"^([a-z0-9-]+)==(\S+)$", versions, re.MULTILINE))
    left_out = set(re.findall(r"^without (\S+)$", versions, re.MULTILINE))
    if unknown := (changed.keys() | left_out) - pins.keys():
        raise ValueError(f"{', '.join(sorted(unknown))}: not among the requirements")
    return "".join(f"{name}=={version}\n" for name, version in (pins | changed).items() if name not in left_out)
