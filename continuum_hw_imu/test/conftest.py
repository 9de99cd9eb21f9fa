"""Processes that the tests of a module share are replaced after a test that failed: it takes no other with it."""

import pytest
from emulated_bench import Shared, emulated_bench

_FAILED = pytest.StashKey[bool]()


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item, call):
    report = yield
    item.stash[_FAILED] = item.stash.get(_FAILED, False) or report.failed
    return report


@pytest.fixture
def failed(request):
    """A function that says whether the test has failed so far."""
    return lambda: request.node.stash.get(_FAILED, False)


@pytest.fixture(scope="module")
def benches(domain, tmp_path_factory):
    with Shared(lambda: emulated_bench(domain, tmp_path_factory.mktemp("bench"))) as benches:
        yield benches


@pytest.fixture
def bench(benches, failed):
    """An emulated bench without faults, at whose port nobody is."""
    yield (bench := benches.get())
    crashed = not failed() and not bench.process.running
    if failed() or not bench.process.running:
        benches.replace()
    else:
        bench.tell("clear")
    assert not crashed, f"the emulator ended: {bench.process.stderr}"
