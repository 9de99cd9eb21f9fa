"""How a command of the page is run, and what shows that it did its work."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Checked:
    """A make target that takes long or runs this very test: it must be in the Makefile, and `by` tests what it does."""

    by: str


@dataclass(frozen=True)
class Run:
    """A command that is run.

    Attributes:
        codes: exit codes that it may have, unless it stays.
        stays: it runs until it is interrupted, while those that follow in the same block run.
        after_ctrl_c: all that stays is interrupted first.
        says: patterns that come in what it writes.
        hears: topics on which so many messages come from its start on.
        nodes: names of ROS nodes that run then.
        listens: a topic on which a further subscription is there then.
        serves: it tells the address of a page, which then answers.
        leaves: patterns of files that are there in the end.
        also: words added for the test alone, `{folder}` in them a folder of its own.
    """

    codes: tuple[int, ...] = (0,)
    stays: bool = False
    after_ctrl_c: bool = False
    says: tuple[str, ...] = ()
    hears: tuple[tuple[str, int], ...] = ()
    nodes: tuple[str, ...] = ()
    listens: str = ""
    serves: bool = False
    leaves: tuple[str, ...] = ()
    also: str = ""


Way = Checked | Run


def way_of(command: str, ways: dict[str, Way]) -> str | None:
    """The longest beginning of `ways` with which a command's words begin; None where no one said how it is run."""
    fitting = [beginning for beginning in ways if f"{command} ".startswith(f"{beginning} ")]
    return max(fitting, key=len, default=None)
