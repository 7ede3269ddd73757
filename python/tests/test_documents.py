"""Vehicles and scenarios: read, changed, refused, copied."""

import copy
import pickle
from pathlib import Path

import numpy as np
import pytest

import hamilcar


def test_reads_by_name_path_and_dict(car, tmp_path):
    assert car.name == "BMW 323i (E30)"
    assert hamilcar.Vehicle(Path(car.source)).total_mass == car.total_mass
    assert hamilcar.Vehicle(car.to_dict()).total_mass == car.total_mass
    assert "formula" in hamilcar.shipped_vehicles()
    assert "step_steer" in hamilcar.shipped_scenarios()


@pytest.mark.parametrize("name", hamilcar.shipped_vehicles())
def test_every_shipped_vehicle_drives_a_step(name):
    simulation = hamilcar.Simulation(name, speed=5.0)
    simulation.step(2)
    assert simulation.time == pytest.approx(0.002)


def test_changes_a_number_by_its_name(car):
    mass = car.total_mass
    car["chassis.mass_kg"] += 100
    assert car.total_mass == pytest.approx(mass + 100)
    car.update({"axle.front.spring.rate_N_per_m": 30e3, "chassis.center_of_mass_m": np.array([-1.2, 0, 0.55])})
    assert car["axle[front].spring.rate_N_per_m"] == 30e3
    assert car["chassis.center_of_mass_m.2"] == 0.55


def test_keeps_what_it_was_when_a_change_is_refused(car):
    before = car.to_dict()
    with pytest.raises(hamilcar.InputError, match=r"key 'chassis.mass_kg' = -3: expected a positive number \[kg\]") as told:
        car.update({"name": "another", "chassis.mass_kg": -3})
    assert told.value.exit_code == 3
    assert isinstance(told.value, ValueError)
    assert car.to_dict() == before


def test_suggests_what_was_meant(car):
    with pytest.raises(KeyError, match="did you mean 'chassis.mass_kg'"):
        car["chassis.mas_kg"]
    with pytest.raises(hamilcar.InputError, match="did you mean 'mass_kg'"):
        car["chassis.mas_kg"] = 3
    with pytest.raises(hamilcar.AccessError, match="No such file"):
        hamilcar.Vehicle("nowhere/car.toml")
    with pytest.raises(hamilcar.AccessError, match="did you mean 'bmw_323i'"):
        hamilcar.Vehicle("bmw_324i")


def test_tells_units_and_bounds_of_every_number(car):
    numbers = car.numbers()
    mass = numbers["chassis.mass_kg"]
    assert (mass.unit, mass.min, mass.min_included) == ("kg", 0, False)
    assert mass.value == car["chassis.mass_kg"]
    assert numbers["gravity_m_per_s2"].is_default
    assert car["gravity_m_per_s2"] == 9.80665
    assert all(one.min <= one.value <= one.max for one in numbers.values())
    assert set(car.numbers("axle.front")) < set(numbers)


def test_all_numbers_of_a_vehicle_can_be_set_to_what_they_are(car):
    """Names, values and bounds are those of the reader: none is refused."""
    for name, number in car.numbers().items():
        if not number.is_default:
            car[name] = number.value
    assert car.total_mass == hamilcar.Vehicle("bmw_323i").total_mass


def test_copies_are_apart(car):
    for other in (hamilcar.Vehicle(car), copy.copy(car), copy.deepcopy(car), car.changed({})):
        other["chassis.mass_kg"] = 2000.0
    assert car["chassis.mass_kg"] == 1002.0


@pytest.mark.parametrize("name", ["bmw_323i", "bmw_323i_paper", "bmw_e90_330i", "truck_semitrailer"])
def test_pickles(name):
    """As for workers in other processes."""
    car = hamilcar.Vehicle(name, {"chassis.mass_kg": 1234.5})
    again = pickle.loads(pickle.dumps(car))
    assert again["chassis.mass_kg"] == 1234.5
    one, other = hamilcar.Simulation(car, speed=10.0), hamilcar.Simulation(again, speed=10.0)
    one.step(50), other.step(50)
    assert np.array_equal(one.state, other.state)


def test_scenarios_are_documents_too():
    scenario = hamilcar.Scenario("step_steer", {"duration_s": 2.0})
    assert scenario.duration == 2.0
    assert scenario.numbers()["initial.velocity_m_per_s"].value == 20
    with pytest.raises(hamilcar.InputError, match="integrator"):
        scenario["solver.integrator"] = "ab9"
        hamilcar.run(scenario)
    with pytest.raises(TypeError, match="expected a scenario, not a vehicle"):
        hamilcar.Scenario(hamilcar.Vehicle())


def test_draws_itself(car):
    for name in hamilcar.shipped_vehicles():
        html = hamilcar.Vehicle(name)._repr_html_()
        assert html.count("<line") > 10 and html.count("<circle") >= 4, name
        assert "nan" not in html
