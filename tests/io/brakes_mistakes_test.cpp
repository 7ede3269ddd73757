// Every mistake a person can make about a brake system is told with its place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "brakes_sample.hpp"
#include "hamilcar/io/vehicle_file.hpp"

namespace hamilcar::io {
namespace {

VehicleDescription read_text(const std::string& text) {
    const TemporaryFolder folder;
    return read_vehicle(folder.write("car.toml", text));
}

class BadBrakes : public testing::TestWithParam<BadInput> {};

TEST_P(BadBrakes, AreToldWithPlaceKeyValueAndExpectation) {
    expect_refused(car_with_brakes(fluid_system, front_brake), GetParam(),
                   [](const std::string& path) { read_vehicle(path); });
}

const std::vector<BadInput> bad_brakes{
    {"UnknownMedium", "\"fluid\"", "\"fluit\"", "\"fluit\"", {"'brakes.medium' = \"fluit\"", "mean 'fluid'?"}},
    {"NoPedalForce",
     "pedal_force_N = 300",
     "",
     "[brakes]",
     {"'brakes.pedal_force_N' is missing", "positive number [N]"}},
    {"ForgottenUnit",
     "master_cylinder_diameter_mm = 23.8",
     "master_cylinder_diameter_m = 0.0238",
     "master_cylinder_diameter_m",
     {"is unknown: did you mean 'master_cylinder_diameter_mm', a positive number [mm]?"}},
    {"DiameterInMeters",
     "diameter_mm = 23.8",
     "diameter_mm = 0.0238",
     "0.0238",
     {"'brakes.master_cylinder_diameter_mm' = 0.0238: expected a cylinder in which", "10 to 400 bar (here ", "[mm]"}},
    {"GainBelowOne", "booster_gain = 5", "booster_gain = 0.5", "0.5\nmaster", {"a number from 1 to 30"}},
    {"NoKnee", "pressure_bar = 100", "pressure_bar = 0", "0\nresponse", {"'brakes.knee_pressure_bar' = 0", "[bar]"}},
    {"TooFastABooster",
     "time_s = 0.03\ncircuits",
     "time_s = 0.001\ncircuits",
     "0.001\ncircuits",
     {"'brakes.response_time_s'", "a number not below 0.005 [s]"}},
    {"TrailerOfACar",
     "response_time_s = 0.03",
     "trailer_response_time_s = 0.1",
     "0.1\ncircuits",
     {"'brakes.trailer_response_time_s' = 0.1: expected a [[trailer]] in this file"}},
    {"UnknownCircuits", "\"diagonal\"", "\"diagonally\"", "\"diagonally\"", {"'front_rear' or 'diagonal'"}},
    {"ThirdCircuit", "circuit = 2", "circuit = 3", "3\n\n[brakes.mod", {"a whole number from 0 to 2"}},
    {"PressureOfAirInFluid",
     "circuits = \"diagonal\"",
     "full_pressure_bar = 100",
     "full_pressure_bar",
     {"'brakes.full_pressure_bar' = 100 is unknown"}},
    {"PumpWithoutPressure",
     "pump_pressure_bar = 180",
     "",
     "[brakes.modulator]",
     {"'brakes.modulator.pump_pressure_bar' is missing: expected a number from 50 to 400 [bar]"}},
    {"NoFlow",
     "pump_flow_cm3_per_s = 8",
     "pump_flow_cm3_per_s = 0",
     "0\npump",
     {"a number above 0, 50 at most [cm^3/s]"}},
    {"VolumeInCubicMeters",
     "volume_cm3 = 3.1",
     "volume_cm3 = 3.1e-6",
     "3.1e-6",
     {"'axle[front].brake.volume_cm3' = 3.1e-6: expected a number from 0.2 to 1000 [cm^3]"}},
    {"ChamberOfFluid",
     "volume_cm3 = 3.1\nline_flow_cm3_per_s = 70",
     "fill_time_s = 0.2",
     "0.2\ntype",
     {"'axle[front].brake.fill_time_s' = 0.2: expected 'volume_cm3' in its place: this is a key of air"}},
    {"FluidAndAir",
     "volume_cm3 = 3.1",
     "fill_time_s = 0.2",
     "0.2\nline",
     {"'axle[front].brake.", "expected either this or '", "', not both"}},
    {"UnknownKind",
     "\"drum\"",
     "\"disk\"",
     "\"disk\"",
     {"'axle[front].brake.type' = \"disk\"", "did you mean 'disc'?"}},
    {"DiscThatAmplifies",
     "\"drum\"",
     "\"disc\"",
     "self_energizing",
     {"'axle[front].brake.self_energizing' = 0.5 is unknown"}},
    {"DrumOfNoKind",
     "self_energizing = 0.5",
     "",
     "[axle.brake]",
     {"'axle[front].brake.self_energizing' is missing: expected a number from 0 to 0.8"}},
    {"DrumThatLocks", "self_energizing = 0.5", "self_energizing = 0.9", "0.9\nheat", {"a number from 0 to 0.8"}},
    {"DrumThatLocksWhenWarm",
     "1.05, 0.6]",
     "1.9, 0.6]",
     "[0.9, 1.9, 0.6]",
     {"'axle[front].brake.heat.friction' = [0.9, ", "numbers of 1.8 at most", "locks by itself"}},
    {"NoCapacity",
     "capacity_J_per_K = 4000",
     "capacity_J_per_K = 0",
     "0\nheat.cooling_W_per_K",
     {"not below 100 [J/K]"}},
    {"CoolingBelowZero", "cooling_W_per_K = 15", "cooling_W_per_K = -1", "-1\nheat", {"from 0 to 1000 [W/K]"}},
    {"AirThatHeats", "K_m = 2.5", "K_m = -2.5", "-2.5", {"cooling_W_s_per_K_m' = -2.5", "from 0 to 100 [W s/(K m)]"}},
    {"TemperaturesThatFall",
     "[0, 300, 700]",
     "[0, 700, 300]",
     "300]",
     {"temperature_degC[2]' = 300: expected a number above the one before, 700 [degC]"}},
    {"OneTemperature",
     "[0, 300, 700]\nheat.friction = [0.9, 1.05, 0.6]",
     "[0]\nheat.friction = [1]",
     "[0]\nheat",
     {"'axle[front].brake.heat.temperature_degC' = [0]: expected 2 to 12 numbers [degC]"}},
    {"FrictionInPercent",
     "[0.9, 1.05, 0.6]",
     "[90, 105, 60]",
     "90, 105",
     {"friction[0]' = 90", "a number from 0.05 to 2"}},
    {"CurveWithoutTemperatures",
     "heat.temperature_degC = [0, 300, 700]",
     "",
     "heat.capacity",
     {"'axle[front].brake.heat.temperature_degC' is missing: expected a list of numbers [degC]"}},
    {"LossInPercent", "loss_s_per_m = 0.004", "loss_s_per_m = 0.4", "0.4\nheat", {"a number from 0 to 0.02 [s/m]"}},
    {"LossWithoutRadius",
     "heat.friction_radius_m = 0.13",
     "",
     "heat.capacity",
     {"'axle[front].brake.heat.friction_radius_m' is missing: expected a positive number [m]"}},
};

INSTANTIATE_TEST_SUITE_P(Files, BadBrakes, testing::ValuesIn(bad_brakes),
                         [](const auto& run) { return run.param.name; });

TEST(BadBrakes, KeysOfALineWantASystem) {
    for (const char* key : {"volume_cm3 = 3", "line_flow_cm3_per_s = 60", "fill_time_s = 0.1", "release_time_s = 0.1",
                            "type = \"drum\"", "heat.capacity_J_per_K = 4000"}) {
        const std::string name = std::string(key).substr(0, std::string(key).find_first_of(" ."));
        expect_error([&] { read_text(car_with_brakes("", std::string(key) + "\n")); }, ExitCode::bad_file,
                     {"'axle[front].brake." + name + "'", "a [brakes] in this file"});
    }
}

TEST(BadBrakes, AirKnowsNeitherVolumesNorPumps) {
    expect_error([] { read_text(car_with_brakes(air_system, "volume_cm3 = 3\n")); }, ExitCode::bad_file,
                 {"'axle[front].brake.volume_cm3' = 3", "'fill_time_s' in its place: this is a key of fluid"});
    expect_error([] { read_text(car_with_brakes(std::string(air_system) + "pump_pressure_bar = 100\n")); },
                 ExitCode::bad_file, {"'brakes.modulator.pump_pressure_bar' = 100", "an empty table"});
    expect_error([] { read_text(car_with_brakes(changed(air_system, "full_pressure_bar = 8", "pedal_ratio = 8"))); },
                 ExitCode::bad_file, {"'brakes.pedal_ratio' = 8 is unknown", "'brakes.full_pressure_bar' is missing"});
}

}  // namespace
}  // namespace hamilcar::io
