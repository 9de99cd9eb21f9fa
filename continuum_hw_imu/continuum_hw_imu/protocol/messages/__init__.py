"""The messages of the protocol, one dataclass each, in SI units, and the number of each type."""

from continuum_hw_imu.protocol.messages.ack import Ack, Result
from continuum_hw_imu.protocol.messages.base import Message, PayloadFault
from continuum_hw_imu.protocol.messages.fault import Fault, FaultCode
from continuum_hw_imu.protocol.messages.hello import Hello, ReceiverLimits, SensorPlace
from continuum_hw_imu.protocol.messages.imu import ImuFrame, Reading
from continuum_hw_imu.protocol.messages.requests import (
    Claim,
    Heartbeat,
    HelloRequest,
    LetGo,
    Release,
    ResetStop,
    SetTension,
    Stop,
)
from continuum_hw_imu.protocol.messages.status import Cause, GuardState, Status
from continuum_hw_imu.protocol.messages.tension import TensionFrame

OF_DEVICE: tuple[type[Message], ...] = (Hello, ImuFrame, TensionFrame, Ack, Status, Fault)
"""Types 0x01 to 0x7F: device to host."""

OF_HOST: tuple[type[Message], ...] = (HelloRequest, Claim, Release, Heartbeat, SetTension, Stop, ResetStop, LetGo)
"""Types 0x81 to 0xFF: host to device."""

__all__ = [
    "OF_DEVICE",
    "OF_HOST",
    "Ack",
    "Cause",
    "Claim",
    "Fault",
    "FaultCode",
    "GuardState",
    "Heartbeat",
    "Hello",
    "HelloRequest",
    "ImuFrame",
    "LetGo",
    "Message",
    "PayloadFault",
    "Reading",
    "ReceiverLimits",
    "Release",
    "ResetStop",
    "Result",
    "SensorPlace",
    "SetTension",
    "Status",
    "Stop",
    "TensionFrame",
]
