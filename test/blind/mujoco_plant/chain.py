"""The arm as a MuJoCo model (MJCF), written by code.

World x is the side of cable 1, z points up, the arm hangs along -z from the base plate at the origin; every hinge turns
about -y, so positive angles bend the arm towards cable 1.
"""

from dataclasses import dataclass, field

from blind.mujoco_plant.parameters import JOINTS, Parameters

CABLES = (1, 2)
BALL_MASS = 0.03  # of the piece between a joint and its play [kg]
BALL_INERTIA = 1e-5  # [kg m^2]
STOP_TIME = 0.0005  # time constant of the stops of a play, critically damped [s]
PLATE_MASS = 0.4  # of a base plate that can turn [kg]
PLATE_INERTIA = 5e-4  # [kg m^2]
POINT_INERTIA = 1e-9  # of bodies meant as points [kg m^2]


@dataclass
class Chain:
    """What the model is built of; effects add to it.

    Attributes:
        p: parameters of the arm.
        play: half clearance of joints with play [rad] by joint.
        finer: how many times more steps the integrator needs.
        base_hinge: stiffness [N m/rad] and damping [N m s/rad] of the hinge that carries the base plate, if any.
        loads: point masses by name: link, distance beyond the link's joint [m], mass [kg].
        straps: attributes of elastic straps from a point of the world to a point of a link, by name: link, point of the
            world (x, z) [m], point of the link (x, z) [m], attributes of MuJoCo's spatial tendon.
    """

    p: Parameters
    play: dict[int, float] = field(default_factory=dict)
    finer: int = 1
    base_hinge: tuple[float, float] | None = None
    loads: dict[str, tuple[int, float, float]] = field(default_factory=dict)
    straps: dict[str, tuple[int, tuple[float, float], tuple[float, float], dict[str, float]]] = field(
        default_factory=dict
    )

    def mjcf(self, step: float) -> str:
        """The model's file for a time step [s]."""
        # stiction as hard as the engine allows: it lets a held joint creep by some 1e-5 rad/s
        stick = f'solreffriction="{2.01 * step:.9g} 1" solimpfriction="0.9999 0.9999 0.001"'
        stop = f'solreflimit="{STOP_TIME} 1" solimplimit="0.9999 0.9999 0.001"'
        return (
            '<mujoco><compiler boundinertia="0" boundmass="0" angle="radian"/>'
            f'<option timestep="{step:.17g}" integrator="implicitfast"><flag contact="disable"/></option>'
            f"<default><joint {stick} {stop}/><tendon {stick}/></default>"
            f"<worldbody>{self._base()}{self._anchors()}</worldbody>"
            f"<tendon>{self._cables()}{self._straps()}</tendon><actuator>{self._winches()}</actuator></mujoco>"
        )

    def _base(self) -> str:
        holes = self._holes(0, 0.0)
        if self.base_hinge is None:
            return holes + self._link(1)
        stiffness, damping = self.base_hinge
        return (
            f'<body><joint name="base" axis="0 -1 0" stiffness="{stiffness:.17g}" damping="{damping:.17g}"/>'
            f"{inertial(PLATE_MASS, PLATE_INERTIA)}{holes}{self._link(1)}</body>"
        )

    def _link(self, i: int) -> str:
        """Link i (from 1) and all that hangs on it."""
        p, b = self.p, self.p.half_spacing
        spring = f'stiffness="{p.stiffness[i - 1]:.17g}" springref="{p.rest_angle[i - 1]:.17g}"'
        friction = f'damping="{p.viscous[i - 1]:.17g}" frictionloss="{p.coulomb[i - 1]:.17g}"'
        hinge = f'<joint name="joint_{i}" axis="0 -1 0" {spring} {friction}/>'
        mass, centre, inertia, at = p.mass[i - 1], b, p.inertia[i - 1], f'pos="0 0 {-(b if i == 1 else 2 * b):.17g}"'
        if i in self.play:
            limits = f'range="{-self.play[i]:.17g} {self.play[i]:.17g}" limited="true" damping="2e-4"'
            ball = f"<body {at}>{hinge}{inertial(BALL_MASS, BALL_INERTIA)}"
            opening = f'{ball}<body><joint name="play_{i}" axis="0 -1 0" {limits}/>'
            mass, centre, inertia = without_ball(mass, centre, inertia)
            closing = "</body></body>"
        else:
            opening, closing = f"<body {at}>{hinge}", "</body>"
        loads = "".join(
            f'<body name="{name}" pos="0 0 {-beyond:.17g}">{inertial(kilograms, POINT_INERTIA)}</body>'
            for name, (link, beyond, kilograms) in self.loads.items()
            if link == i
        )
        ends = "".join(
            f'<site name="{name}_link" pos="{x:.17g} 0 {z:.17g}"/>'
            for name, (link, _, (x, z), _) in self.straps.items()
            if link == i
        )
        rest = self._link(i + 1) if i < JOINTS else ""
        return f"{opening}{inertial(mass, inertia, -centre)}{self._holes(i, -b)}{ends}{loads}{rest}{closing}"

    def _holes(self, disc: int, z: float) -> str:
        sides = zip(CABLES, (self.p.hole_radius, -self.p.hole_radius), strict=True)
        return "".join(f'<site name="hole_{c}_{disc}" pos="{x:.17g} 0 {z:.17g}"/>' for c, x in sides)

    def _cables(self) -> str:
        """Each cable from every disc to the tip: the first carries the pull, each carries one disc's friction."""
        return "".join(
            f'<spatial name="cable_{c}_{k}">'
            + "".join(f'<site site="hole_{c}_{disc}"/>' for disc in range(k, JOINTS + 1))
            + "</spatial>"
            for c in CABLES
            for k in range(JOINTS)
        )

    def _winches(self) -> str:
        """Tension shortens its cable."""
        return "".join(f'<general tendon="cable_{c}_0" gear="-1"/>' for c in CABLES)

    def _anchors(self) -> str:
        return "".join(
            f'<site name="{name}_world" pos="{x:.17g} 0 {z:.17g}"/>' for name, (_, (x, z), _, _) in self.straps.items()
        )

    def _straps(self) -> str:
        return "".join(
            f'<spatial name="{name}" {" ".join(f'{key}="{value:.17g}"' for key, value in attributes.items())}>'
            f'<site site="{name}_world"/><site site="{name}_link"/></spatial>'
            for name, (_, _, _, attributes) in self.straps.items()
        )


def without_ball(mass: float, centre: float, inertia: float) -> tuple[float, float, float]:
    """The rest of a link whose ball is a piece of its own, so that with the ball at its joint it is that link.

    Mass [kg], its centre beyond the joint [m], inertia about that [kg m^2]; of the link, and of what is left of it.
    """
    rest = mass - BALL_MASS
    there = centre * mass / rest
    return rest, there, inertia + mass * centre**2 - BALL_INERTIA - rest * there**2


def inertial(mass: float, inertia: float, z: float = 0.0) -> str:
    """The element of a body's mass [kg] and inertia about its centre [kg m^2], which is at z [m]."""
    return f'<inertial pos="0 0 {z:.17g}" mass="{mass:.17g}" diaginertia="{" ".join([f"{inertia:.17g}"] * 3)}"/>'
