// Every mistake a person can make about power units and differentials is told with its place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hamilcar/description/powertrain.hpp"
#include "hamilcar/io/vehicle_file.hpp"
#include "powertrain_sample.hpp"

namespace hamilcar::io {
namespace {

class BadPowertrain : public testing::TestWithParam<BadInput> {};

TEST_P(BadPowertrain, IsToldWithPlaceKeyValueAndExpectation) {
    expect_refused(car_driven_by(four_driven_wheels), GetParam(), [](const std::string& path) { read_vehicle(path); });
}

const std::vector<BadInput> bad_powertrains{
    {"UnknownKind", "\"viscous\"", "\"viscos\"", "\"viscos\"", {"'differential[front].kind'", "mean 'viscous'?"}},
    {"KeyOfAnotherKind",
     "viscosity_N_m_s_per_rad = 12",
     "viscosity_N_m_s_per_rad = 12\nbias_ratio = 2",
     "bias_ratio = 2",
     {"'differential[front].bias_ratio' = 2 is unknown"}},
    {"BiasBelowOne", "bias_ratio = 3", "bias_ratio = 0.5", "0.5\nshaft", {"expected a number not below 1"}},
    {"LockingValueInPercent",
     "locking_value_drive = 0.25",
     "locking_value_drive = 25",
     "25\nlocking",
     {"'differential[rear].locking_value_drive' = 25: expected a number from 0 to 1"}},
    {"OneOutput",
     "[\"rear_left\", \"rear_right\"]",
     "[\"rear_left\"]",
     "[\"rear_left\"]",
     {"'differential[rear].outputs' = [\"rear_left\"]: expected two names of wheels or of other differentials"}},
    {"NoOutputs",
     "outputs = [\"rear_left\", \"rear_right\"]",
     "",
     "[[differential]]\nname = \"rear\"",
     {"'differential[rear].outputs' is missing: expected two names"}},
    {"UnknownOutput",
     "\"rear_left\"",
     "\"raer_left\"",
     "[\"raer_left\"",
     {"which 'raer_left' is not; did you mean 'rear_left'?"}},
    {"WheelDrivenTwice",
     "\"front_right\", \"front_left\"",
     "\"front_right\", \"rear_left\"",
     "[\"front_right\", \"rear_left\"",
     {"'differential[front].outputs'", "nothing else drives, as something does 'rear_left'"}},
    {"DrivesTheSameTwice",
     "[\"front\", \"rear\"]",
     "[\"rear\", \"rear\"]",
     "[\"rear\", \"rear\"]",
     {"'differential[center].outputs'", "as something does 'rear'"}},
    {"Circle",
     "\"front_right\", \"front_left\"",
     "\"front_right\", \"center\"",
     "[\"front\", \"rear\"]",
     {"'differential[center].outputs'", "these lead back to their own input"}},
    {"NameOfAWheel",
     "name = \"center\"",
     "name = \"front_left\"",
     "\"front_left\"\nkind",
     {"'differential[front_left].name'", "a name that no other differential or wheel has"}},
    {"DrivesAWheelOfADifferential",
     "output = \"rear\"",
     "output = \"rear_left\"",
     "\"rear_left\"\ninertia",
     {"'power_unit[motor].output' = \"rear_left\": expected a wheel that no differential drives, or the differential "
      "'rear'"}},
    {"TwoUnitsOfOneName", "name = \"motor\"", "name = \"engine\"", "\"engine\"\noutput = \"rear\"", {"no other power"}},
    {"UnitNamedLikeAWheel",
     "name = \"motor\"",
     "name = \"rear_left\"",
     "\"rear_left\"\noutput",
     {"no other power unit, axle, wheel or trailer has"}},
    {"NeitherEngineNorMotor",
     "[power_unit.motor]",
     "[power_unit.moter]",
     "[[power_unit]]\nname = \"motor\"",
     {"'power_unit[motor].engine' is missing"}},
    {"EngineAndMotor",
     "[power_unit.converter]",
     "[power_unit.motor]\nmax_torque_N_m = 3\n[power_unit.converter]",
     "[power_unit.motor]\nmax_torque_N_m = 3",
     {"'power_unit[engine].motor'", "either this or 'engine', not both"}},
    {"ClutchAndConverter",
     "[power_unit.gearbox]",
     "[power_unit.clutch]\ncapacity_N_m = 3\n[power_unit.gearbox]",
     "[power_unit.converter]",
     {"either this or 'clutch', not both"}},
    {"EngineThatCannotSlip",
     "[power_unit.converter]",
     "[power_unit.konverter]",
     "[power_unit.engine]",
     {"'power_unit[engine].engine'", "a [power_unit.clutch] that slips or a [power_unit.converter] beside it"}},
    {"SpeedsNotIncreasing",
     "[600, 3000, 6000]",
     "[600, 600, 6000]",
     "600, 6000]",
     {"'power_unit[engine].engine.speed_rpm[1]' = 600: expected a number above the one before, 600 [rpm]"}},
    {"TorquesTooFew",
     "[100, 200, 0]",
     "[100, 200]",
     "[100, 200]",
     {"full_load_N_m' = [100, 200]: expected 3 numbers, one for each of 'speed_rpm' [N m]"}},
    {"OverrunAboveFullLoad",
     "[100, 200, 0]",
     "[100, -30, 0]",
     "[100, -30, 0]",
     {"no torque below that of 'overrun_N_m' [N m]"}},
    {"OverrunThatPushes",
     "[-10, -20, -40]",
     "[-10, 20, -40]",
     "20, -40]",
     {"engine.overrun_N_m[1]' = 20: expected a number not above zero [N m]"}},
    {"DragAboveTheStarter",
     "[-10, -20, -40]",
     "[-31, -20, -40]",
     "[-31, -20, -40]",
     {"engine.overrun_N_m' = [-31, -20, -40]: expected numbers above -30 up to half of 'idle_rpm', where it fires"}},
    {"NoLimiter",
     "[100, 200, 0]",
     "[100, 200, 150]",
     "[100, 200, 150]",
     {"a last torque of 0 or below: there the engine is limited [N m]"}},
    {"TooSoonForAStep",
     "response_time_s = 0.1",
     "response_time_s = 1e-3",
     "1e-3\nstiffness",
     {"'power_unit[engine].response_time_s' = 1e-3: expected 0, at once, or a number not below 0.005 [s]"}},
    {"RotorLargerThanTheCar",
     "inertia_kg_m2 = 0.05",
     "inertia_kg_m2 = 500",
     "500\nstiffness",
     {"'power_unit[motor].inertia_kg_m2' = 500: expected a rotor that leaves the chassis"}},
    {"ConverterThatMakesPower",
     "torque_ratio = [2, 1, 1]",
     "torque_ratio = [2, 2, 1]",
     "[2, 2, 1]",
     {"converter.torque_ratio' = [2, 2, 1]: expected numbers that times their speed ratio, there and between, are 1 at "
      "most"}},
    {"ConverterThatEndsEarly",
     "[0, 0.9, 1]",
     "[0, 0.5, 0.9]",
     "[0, 0.5, 0.9]",
     {"speed_ratio' = [0, 0.5, 0.9]: expected a last number of 1"}},
    {"ConverterThatPassesTorqueWhenAlike",
     "[250, 100, 0]",
     "[250, 100, 9]",
     "[250, 100, 9]",
     {"pump_torque_at_2000rpm_N_m' = [250, 100, 9]: expected a last number of 0: what turns alike passes no torque"}},
    {"ShiftsUpAboveTheLimiter",
     "upshift_rpm = 5500",
     "upshift_rpm = 6500",
     "6500\nupshift",
     {"gearbox.upshift_rpm' = 6500: expected a number below the speed at which the torque ends, 6000 [rpm]"}},
    {"IdleAboveAll",
     "idle_rpm = 900",
     "idle_rpm = 7000",
     "7000\nspeed",
     {"a number below the last of 'speed_rpm' [rpm]"}},
    {"PartLoadNotIncreasing", "throttle = 0.5", "throttle = 1", "1\ntorque", {"between the one before, 0, and 1"}},
    {"PartLoadTorquesTooFew",
     "[90, 120, 0]",
     "[90, 120]",
     "[90, 120]",
     {"engine.part_load[0].torque_N_m' = [90, 120]: expected 3 numbers"}},
    {"ConverterAboveOne", "[0, 0.9, 1]", "[0, 0.9, 1.5]", "[0, 0.9, 1.5]", {"speed_ratio'", "numbers from 0 to 1"}},
    {"PumpTorquesTooFew",
     "[250, 100, 0]",
     "[250, 0]",
     "[250, 0]",
     {"pump_torque_at_2000rpm_N_m' = [250, 0]: expected 3 numbers, one for each of 'speed_ratio' [N m]"}},
    {"GearsNotDecreasing", "[3, 1.5, 1]", "[3, 1.5, 2]", "[3, 1.5, 2]", {"gearbox.ratios'", "numbers that decrease"}},
    {"EfficiencyAboveOne", "efficiency = 0.9", "efficiency = 90", "90\nshift", {"a number above 0, 1 at most"}},
    {"ShiftsBackAtOnce",
     "downshift_rpm = 2500",
     "downshift_rpm = 2800",
     "2800\ndown",
     {"gearbox.downshift_rpm' = 2800: expected a number below 2750, which is left after shifting up [rpm]"}},
    {"AutomaticThatDoesNotShift",
     "upshift_rpm = 5500\nupshift_closed_rpm = 2000\n",
     "",
     "[power_unit.gearbox]",
     {"gearbox.upshift_rpm' is missing: expected a positive number: an automatic gearbox shifts by itself"}},
};

INSTANTIATE_TEST_SUITE_P(EveryMistake, BadPowertrain, testing::ValuesIn(bad_powertrains),
                         [](const auto& test) { return test.param.name; });

// One that nothing drives, and a trailer's wheels: too much to change in one place.
TEST(PowertrainFile, DifferentialsHaveAnInputAndStayOnTheMotorVehicle) {
    const std::string idle = R"([[differential]]
name = "rear"
outputs = ["rear_left", "rear_right"]
shaft_stiffness_N_m_per_rad = 8e3
)";
    const TemporaryFolder folder;
    const std::string car = folder.write("car.toml", car_driven_by(idle));
    expect_error([&] { read_vehicle(car); }, ExitCode::bad_file,
                 {"key 'differential[rear].name' = \"rear\": expected a differential that a power unit has"});
    const std::string truck =
        folder.write("truck.toml", "base = \"" + repository_path("vehicles/truck_semitrailer.toml") +
                                       "\"\n[[differential]]\nname = \"rear_2\"\n" +
                                       "outputs = [\"trailer_1_left\", \"rear_2_right\"]\n");
    expect_error([&] { read_vehicle(truck); }, ExitCode::bad_file,
                 {"wheels of the motor vehicle, which 'trailer_1_left' is not"});
}

TEST(PowertrainFile, HasPlacesForSoMany) {
    std::string units;
    for (int i = 0; i <= max_power_units; ++i) {
        units += "[[power_unit]]\nname = \"unit_" + std::to_string(i) +
                 "\"\noutput = \"rear\"\ninertia_kg_m2 = 0.1\nstiffness_N_m_per_rad = 1e3\n[power_unit.motor]\n"
                 "max_torque_N_m = 1\nmax_power_W = 1\nmax_speed_rpm = 1\n";
    }
    const TemporaryFolder folder;
    const std::string path = folder.write("car.toml", shipped_car_text() + units);
    expect_error([&] { read_vehicle(path); }, ExitCode::bad_file, {"'power_unit'", "8 power units at most"});
}

}  // namespace
}  // namespace hamilcar::io
