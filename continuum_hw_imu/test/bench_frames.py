"""Messages, frames and spoiled bytes of the bench protocol, for property tests."""

from hypothesis import strategies as st

from continuum_hw_imu.protocol import messages as m
from continuum_hw_imu.protocol.frame import Frame
from continuum_hw_imu.protocol.messages.fault import FaultCode

U8, U16, U32 = (st.integers(0, (1 << bits) - 1) for bits in (8, 16, 32))
I16 = st.integers(-(1 << 15), (1 << 15) - 1)
SET_POINTS = st.lists(st.integers(0, 0x7FFF).map(lambda steps: steps / 100), min_size=1, max_size=8).map(tuple)
MEASURED = st.none() | st.integers(-0x7FFF, 0x7FFF).map(lambda steps: steps / 100)
LETTERS = st.characters(min_codepoint=0x20, max_codepoint=0x7E)
LIMITS = st.builds(
    m.ReceiverLimits,
    st.integers(0, 0x7FFF).map(lambda steps: steps / 100),
    U16.map(lambda steps: steps / 10),
    *(U16.map(lambda steps: steps / 1000) for _ in range(3)),
)
PLACES = st.lists(st.builds(m.SensorPlace, st.integers(1, 255), st.text(LETTERS, max_size=12)), min_size=1, max_size=10)
READING = st.builds(m.Reading, I16, I16, I16, I16, I16, I16, U8)

OF_DEVICE = st.one_of(
    st.builds(
        m.Hello,
        U32,
        st.text(LETTERS, max_size=24),
        st.integers(1, 0xFFFF).map(lambda steps: steps / 100),
        PLACES.map(tuple),
        st.integers(1, 8),
        LIMITS,
    ),
    st.builds(m.ImuFrame, U16, st.lists(READING, min_size=1, max_size=10).map(tuple)),
    SET_POINTS.flatmap(lambda wanted: st.builds(m.TensionFrame, st.just(wanted), st.tuples(*[MEASURED] * len(wanted)))),
    st.builds(m.Ack, U16, U8, st.sampled_from(m.Result)),
    st.builds(
        m.Status,
        st.sampled_from(m.GuardState),
        st.sampled_from(m.Cause),
        st.booleans(),
        U16,
        U16,
        U16,
        st.lists(st.none() | st.integers(0, 100), max_size=10).map(tuple),
    ),
    st.builds(m.Fault, st.sampled_from(FaultCode), U8),
)
OF_HOST = st.one_of(
    st.builds(m.HelloRequest),
    st.builds(m.Stop),
    *(st.builds(kind, U32) for kind in (m.Claim, m.Release, m.Heartbeat, m.LetGo)),
    st.builds(m.ResetStop, U32, U32),
    st.builds(m.SetTension, U32, U32, SET_POINTS),
)
FRAMES = st.builds(Frame, U16, U32, OF_DEVICE | OF_HOST)


@st.composite
def cut_up(draw: st.DrawFn, data: bytes) -> list[bytes]:
    """``data`` in pieces, as a port gives them."""
    cuts = sorted(draw(st.lists(st.integers(0, len(data)), max_size=12)))
    return [data[a:b] for a, b in zip([0, *cuts], [*cuts, len(data)], strict=True)]
