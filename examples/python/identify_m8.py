"""What a measured stop of a BMW M8 tells about the car: python identify_m8.py [report.html]

The run is in the folder bmw_m8, which says where it is from: coasting in gear from 22 m/s, then the brake. There is no model of an M8 here. A BMW E90 with the M8's mass, axle loads and wheels takes its
place; its suspension is not the M8's, and neither are the numbers found for it.
"""

import sys
from pathlib import Path

import numpy as np

import hamilcar
from hamilcar.identify import Free, Measurement, Unknown, identify

DATA = Path(__file__).resolve().parent / "bmw_m8"
BEGIN = 5.2  # coasting has settled [s]
ENDS = (7.15, 7.3)  # before the brakes slip; what is well known does not depend on which
TOTAL_MASS = 2074.4  # measured by the authors [kg]


def car():
    """The E90 with the authors' numbers of the M8; the center of mass is 1.331 m behind the front axle, of 2.827 m of wheelbase."""
    e90 = hamilcar.Vehicle("bmw_e90_330i")
    mass = e90["chassis.mass_kg"] + TOTAL_MASS - e90.total_mass
    ratio = TOTAL_MASS / e90.total_mass
    changes = {"chassis.mass_kg": mass, "chassis.center_of_mass_m.0": -1.331 / 2.827 * 2.757}
    for name, radius in (("front", 0.350), ("rear", 0.354)):
        changes[f"axle.{name}.spring.force_at_design_N"] = ratio * e90[f"axle.{name}.spring.force_at_design_N"]
        changes[f"tire.{name}.radius_m"] = radius + 0.007
        changes[f"tire.{name}.rolling_radius_m"] = radius
        changes[f"tire.{name}.friction"] = 1.3  # what it brakes with later on
    changes["axle.front.brake.max_torque_N_m"] = 0.30 * 17500.0
    changes["axle.rear.brake.max_torque_N_m"] = 0.20 * 17500.0
    changes["aerodynamics.drag_coefficient"] = 0.33
    changes["aerodynamics.frontal_area_m2"] = 2.25
    return e90.changed(changes)


def measurement(end):
    fast, slow = (np.genfromtxt(DATA / name, delimiter=",", skip_header=1) for name in ("fast.csv", "slow.csv"))
    time = np.arange(BEGIN, end, 0.01)

    def column(table, number):
        return np.interp(time, table[:, 0], table[:, number])

    wheels = [column(fast, number) for number in (7, 8, 9, 10)]  # [rad/s]
    rpm = 60 / (2 * np.pi)
    return Measurement(
        time - BEGIN,
        # Torques as the car reports them, brakes as a share of 17500 N m.
        {"drive_torque": column(slow, 13), "brake": np.clip(-column(slow, 12) / 17500.0, 0, 1)},
        {
            "chassis.longitudinal_velocity": column(fast, 4), "chassis.angle.pitch": np.degrees(column(slow, 2)),
            "front_left.wheel.spin": rpm * 0.5 * (wheels[0] + wheels[1]),
            "rear_left.wheel.spin": rpm * 0.5 * (wheels[2] + wheels[3]),
        },
        {
            "chassis.longitudinal_velocity": 0.02, "chassis.angle.pitch": 0.03, "front_left.wheel.spin": 0.7,
            "rear_left.wheel.spin": 0.7,
        },
        speed=float(np.interp(BEGIN, fast[:, 0], fast[:, 4])),
        delay={"chassis.longitudinal_velocity": Free(-0.05, 0.1), "chassis.angle.pitch": Free(-0.05, 0.15)},
        bias={"chassis.angle.pitch": Free(-2.0, 2.0), "chassis.longitudinal_velocity": Free(-0.3, 0.3)},
        name="stop",
    )


def unknowns():
    both = ("front", "rear")
    return [
        # What resists the reported torques: the engine, turning with the wheels in second gear, is in it.
        Unknown("chassis.mass_kg", 1500.0, 2900.0),
        Unknown("brakes", 0.5, 1.5, multiplies=[f"axle.{one}.brake.max_torque_N_m" for one in both]),
        Unknown("springs", 0.4, 4.0, multiplies=[f"axle.{one}.spring.rate_N_per_m" for one in both]),
        Unknown("chassis.center_of_mass_m.2", 0.35, 0.75),
        Unknown("chassis.inertia_kg_m2.1", 2210.0, 3300.0),
        Unknown("slip stiffness", 0.3, 3.0, multiplies=[f"tire.{one}.longitudinal_stiffness_per_load" for one in both]),
        Unknown("tire.front.rolling_radius_m", 0.33, 0.36), Unknown("tire.rear.rolling_radius_m", 0.33, 0.37),
    ]


def main(report=None):
    found = [identify(car(), unknowns(), [measurement(end)], step=2e-3) for end in ENDS]
    print(found[-1].text())
    print("with data up to", " or ".join(f"{end} s" for end in ENDS))
    for name in found[-1].names:
        print(f"  {name:48s}", *(f"{one.values[name]:10.5g}" for one in found))
    print("resists like", *(f"{one.vehicle.total_mass:.0f} kg" for one in found), f"; at rest it has {TOTAL_MASS:.0f} kg")
    if report:
        found[-1].to_html(report)


if __name__ == "__main__":
    main(*sys.argv[1:])
