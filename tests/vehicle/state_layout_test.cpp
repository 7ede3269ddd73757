// The map of a state against the views that the blocks read and write it by.
#include "hamilcar/vehicle/state_layout.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "hamilcar/vehicle/state.hpp"
#include "support/car.hpp"

namespace hamilcar {
namespace {

// Notes which name each number has by the view that it is reached through.
class Views {
public:
    explicit Views(const VehicleDescription& d) : described_(d), vehicle_(d) {
        chassis();
        for (std::size_t s = 0; s < vehicle_.suspensions.size(); ++s) suspension(s);
        for (std::size_t i = 0; i < vehicle_.trailers.size(); ++i) trailer(i);
        if (vehicle_.powertrain.exists()) powertrain();
        brakes(), steering(), actuators();
    }
    // By their places.
    const std::map<std::ptrdiff_t, std::string>& names() const { return names_; }
    int size() const { return vehicle_.state_size; }

private:
    void note(const double& number, const std::string& name) {
        EXPECT_TRUE(names_.emplace(&number - state_.values.data(), name).second) << name;
    }
    void chassis() {
        const char* const axes[] = {"x", "y", "z"};
        for (int i = 0; i < 3; ++i) {
            note(state_.position().data()[i], std::string("position.") + axes[i]);
            note(state_.momentum().data()[i], std::string("momentum.") + axes[i]);
            note(state_.momentum().data()[3 + i], std::string("angular_momentum.") + axes[i]);
            note(state_.orientation().data()[1 + i], std::string("orientation.") + axes[i]);
        }
        note(state_.orientation().data()[0], "orientation.w");
        note(state_.work(), "work");
    }
    void suspension(std::size_t s) {
        const Suspension<double>& one = vehicle_.suspensions[s];
        const SuspensionDescription& d = described_.suspensions[s];
        const auto at = one.state(state_.values.data());
        const auto number = [](int i) { return std::to_string(i + 1); };
        for (int i = 0; i < one.linkage.nV(); ++i) {
            note(at.independent[i], d.name + ".independent." + number(i));
            note(at.momentum[i], d.name + ".momentum." + number(i));
        }
        for (int i = 0; i < one.linkage.nW(); ++i) note(at.dependent[i], d.name + ".dependent." + number(i));
        for (std::size_t i = 0; i < one.wheels.size(); ++i) {
            const auto wheel = one.wheel_state(static_cast<int>(i), state_.values.data());
            const std::string& name = d.wheels[i].name;
            note(wheel.spin_momentum, name + ".spin_momentum"), note(wheel.brake_windup, name + ".brake_windup");
            for (int k = 0; k < one.wheels[i].tires; ++k) {
                note(wheel.deflection[2 * k], name + ".deflection_x" + (k == 0 ? "" : "_2"));
                note(wheel.deflection[2 * k + 1], name + ".deflection_y" + (k == 0 ? "" : "_2"));
            }
        }
    }
    void trailer(std::size_t i) {
        const Trailer<double>& one = vehicle_.trailers[i];
        const std::vector<std::string> angles = hitch_angles(described_.trailers[i].hitch);
        ASSERT_EQ(angles.size(), static_cast<std::size_t>(one.freedoms()));
        const std::string& name = described_.trailers[i].name;
        for (std::size_t j = 0; j < angles.size(); ++j) {
            const std::size_t place = static_cast<std::size_t>(one.offset) + j;
            note(state_.values[place], name + ".hitch." + angles[j]);
            note(state_.values[place + angles.size()], name + ".hitch_momentum." + angles[j]);
        }
    }
    void powertrain() {
        const Powertrain<double>& one = vehicle_.powertrain;
        for (std::size_t i = 0; i < one.units.size(); ++i) {
            const auto unit = one.units[i].state(state_.values.data());
            const std::string& name = described_.power_units[i].name;
            note(unit.momentum, name + ".momentum"), note(unit.windup, name + ".windup");
            note(unit.throttle, name + ".throttle"), note(unit.oil_torque, name + ".converter_torque");
            if (!one.units[i].shafts.exist()) continue;
            note(unit.shafts[0], name + ".gearbox_momentum"), note(unit.shafts[1], name + ".shafts_windup");
        }
        for (std::size_t i = 0; i < one.differentials.size(); ++i) {
            note(one.windup(i, state_.values.data()), described_.differentials[i].name + ".windup");
        }
        if (one.battery.exists()) {
            const auto battery = one.battery.state(state_.values.data());
            note(battery.charge, "battery.charge"), note(battery.voltage, "battery.voltage");
        }
        note(one.supplied(state_.values.data()), "energy_supplied");
    }

    void brakes() {
        const BrakeSystem<double>& system = vehicle_.brakes;
        double* values = state_.values.data();
        for (std::size_t i = 0; i < system.source.size(); ++i) {
            const std::string unit = i == 0 ? "" : described_.trailers[i - 1].name + ".";
            note(system.control(i, values), unit + "control_pressure");
        }
        const std::vector<std::string> wheels = wheel_names();
        for (std::size_t i = 0; i < system.lines.size(); ++i) {
            const std::string& wheel = wheels[static_cast<std::size_t>(system.lines[i].wheel)];
            note(system.pressure(i, values), wheel + ".brake.pressure");
            note(system.temperature(i, values), wheel + ".brake.temperature");
        }
    }
    std::vector<std::string> wheel_names() const {
        std::vector<std::string> out;
        for_each_wheel(described_, [&](const auto& wheel, std::size_t) { out.push_back(wheel.name); });
        return out;
    }
    void steering() {
        if (!vehicle_.steering.exists()) return;
        const auto at = vehicle_.steering.state(state_.values.data());
        note(at.rack, "rack.displacement"), note(at.rack_momentum, "rack.momentum");
        note(at.wheel, "steering_wheel.angle"), note(at.wheel_momentum, "steering_wheel.momentum");
        note(at.rack_windup, "rack.windup"), note(at.wheel_windup, "steering_wheel.windup");
        note(at.assist, "assist.force");
    }
    void actuators() {
        const CommandLayout commands(described_);
        for (std::size_t i = 0; i < vehicle_.actuators.size(); ++i) {
            const auto command = static_cast<std::size_t>(vehicle_.actuators[i].command);
            note(state_.values[static_cast<std::size_t>(vehicle_.actuator_place) + i],
                 commands.commands()[command].name);
        }
        for (std::size_t i = 0; i < vehicle_.axle_steers.size(); ++i) {
            const auto place = static_cast<std::size_t>(vehicle_.axle_steers[i].place);
            note(state_.values[place], described_.axle_steers[i].axle + ".steer");
            note(state_.values[place + 1], described_.axle_steers[i].axle + ".steer_rate");
        }
    }

    const VehicleDescription& described_;
    Vehicle<double> vehicle_;
    State<double> state_;
    std::map<std::ptrdiff_t, std::string> names_;
};

// Its first damper and its first bar, so that controllers command both.
void make_adjustable(VehicleDescription& car) {
    if (car.controllers.empty()) return;
    car.suspensions[0].dampers[0].damper.soft = 0.5;
    if (!car.anti_roll_bars.empty()) car.anti_roll_bars[0].max_force = 1000;
}

// A battery, a gearbox with an inertia, a rear axle with an actuator of its own.
void make_further(VehicleDescription& car) {
    if (car.power_units.empty()) return;
    car.battery = {.exists = true, .capacity = 1, .charge = {0}, .voltage = {400}};
    car.power_units.back().shafts = {.exists = true, .gearbox_inertia = 0.01, .stiffness = 1e4};
    car.axle_steers = {{.axle = "rear", .travel = 0.01, .frequency = 30}};
}

TEST(StateLayout, NamesEveryNumberThatTheBlocksReach) {
    std::set<StateKind> kinds;
    for (const auto& entry : std::filesystem::directory_iterator(test::source_path("vehicles"))) {
        if (entry.path().extension() != ".toml") continue;
        SCOPED_TRACE(entry.path().filename().string());
        VehicleDescription car = io::read_vehicle(entry.path().string());
        if (car.steering.mechanics) car.steering.is_free = true;
        make_adjustable(car);
        make_further(car);
        const StateLayout layout(car);
        const Views views(car);
        ASSERT_EQ(layout.size(), views.size());
        ASSERT_EQ(layout.numbers().size(), views.names().size());  // no number without a view, none with two
        for (const auto& [place, name] : views.names()) {
            EXPECT_EQ(layout.numbers()[static_cast<std::size_t>(place)].name, name);
        }
        for (const StateNumber& number : layout.numbers()) kinds.insert(number.kind);
    }
    EXPECT_EQ(kinds.size(), state_kinds().size());  // each is in some vehicle
}

// docs/theory/formulation.md shows what state_layout.cpp says.
TEST(StateLayout, IsTheTableOfTheDocs) {
    std::ostringstream rows;
    for (const StateKindInfo& kind : state_kinds()) {
        rows << "| " << kind.meaning << " | " << kind.symbol << " | " << kind.unit << " | " << kind.block << " |\n";
    }
    std::ifstream file(test::source_path("docs/theory/formulation.md"));
    const std::string page{std::istreambuf_iterator<char>(file), {}};
    EXPECT_THAT(page, testing::HasSubstr("| number of the state | symbol | unit | block that gives its rate |\n"
                                         "| --- | --- | --- | --- |\n" +
                                         rows.str()));
}

}  // namespace
}  // namespace hamilcar
