"""Of what came between two frames the last about each thing is kept, and looked at once."""

from continuum_manipulator.newest import Newest


def test_the_last_about_each_thing_is_taken_once() -> None:
    newest = Newest[int]()
    for about, item in (("joints", 1), ("cables", 2), ("joints", 3), ("other joints", 4)):
        newest.keep(about, item)
    assert newest.take() == [3, 2, 4]
    assert newest.take() == []
    newest.keep("cables", 5)
    assert newest.take() == [5]
