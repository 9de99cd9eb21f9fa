"""Every effect that can be hidden, by name: those that a library of effects may hold, and those outside of any."""

from blind.plant.effect import Effect
from blind.plant.effects.backlash import Backlash
from blind.plant.effects.base import BaseCompliance, BaseTilt, RemountedBase
from blind.plant.effects.cables import ActuatorLag, Capstan, ElasticCable, SlackCable, TensionScale
from blind.plant.effects.friction import JointFriction, LoadFriction
from blind.plant.effects.masses import Inertia, TipPayload
from blind.plant.effects.outside import DroppingLoad, KinkedSpring, Magnet, RubbingDisc, ShakenBase
from blind.plant.effects.presliding import Presliding
from blind.plant.effects.quadratic_drag import QuadraticDrag
from blind.plant.effects.sensor_cable import SensorCable
from blind.plant.effects.sensors import AngleOffset, GyroDrift, SensorDelay, SensorScale
from blind.plant.effects.springs import HardeningSpring, JointStiffness, RestAngle

_ALL: tuple[type[Effect], ...] = (
    RestAngle,
    JointStiffness,
    HardeningSpring,
    Inertia,
    TipPayload,
    BaseTilt,
    BaseCompliance,
    JointFriction,
    Presliding,
    LoadFriction,
    QuadraticDrag,
    SensorCable,
    Backlash,
    Capstan,
    ElasticCable,
    SlackCable,
    ActuatorLag,
    AngleOffset,
    GyroDrift,
    SensorDelay,
    SensorScale,
    Magnet,
    RubbingDisc,
    DroppingLoad,
    KinkedSpring,
    ShakenBase,
    TensionScale,  # these last, so that what the others' cases draw is as it was
    RemountedBase,
)
EFFECTS = {effect.name: effect for effect in _ALL}
LIBRARY = tuple(name for name, effect in EFFECTS.items() if effect.in_a_library)
OUTSIDE = tuple(name for name, effect in EFFECTS.items() if not effect.in_a_library)
