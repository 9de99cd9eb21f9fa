"""Every effect that can be hidden, by name: those that a library of effects may hold, and those outside of any."""

from blind.mujoco_plant.effect import Effect
from blind.mujoco_plant.effects.backlash import Backlash
from blind.mujoco_plant.effects.base import BaseCompliance, BaseTilt, RemountedBase
from blind.mujoco_plant.effects.cables import ActuatorLag, Capstan, ElasticCable, SlackCable, TensionScale
from blind.mujoco_plant.effects.friction import JointFriction, LoadFriction
from blind.mujoco_plant.effects.masses import Inertia, TipPayload
from blind.mujoco_plant.effects.outside_library import DroppingLoad, KinkedSpring, Magnet, RubbingDisc, ShakenBase
from blind.mujoco_plant.effects.presliding import Presliding
from blind.mujoco_plant.effects.quadratic_drag import QuadraticDrag
from blind.mujoco_plant.effects.sensor_cable import SensorCable
from blind.mujoco_plant.effects.sensors import AngleOffset, GyroDrift, SensorDelay, SensorScale
from blind.mujoco_plant.effects.springs import HardeningSpring, JointStiffness, RestAngle

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
