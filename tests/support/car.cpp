#include "support/car.hpp"

#include <gtest/gtest.h>

namespace hamilcar::test {

VehicleDescription conservative_car() {
    VehicleDescription car = paper_car();
    for (SuspensionDescription& suspension : car.suspensions) {
        suspension.dampers[0].damper = {{-1, 1}, {0, 0}};
        const auto& tire = std::get<LinearTireDescription>(suspension.wheels[0].tire);
        suspension.wheels[0].tire = SpringTireDescription{tire.radius, tire.rolling_radius, tire.vertical_stiffness};
    }
    car.aerodynamics = {};
    return car;
}

Model<double> make_model(const VehicleDescription& car) {
    VehicleDescription alone = car;
    alone.power_units.clear(), alone.differentials.clear();
    return {.vehicle = Vehicle<double>(alone), .road = PlaneRoad<double>(0, 0, 1)};
}

Energy<double> energy_of(const Model<double>& model, const State<double>& state, const Input<double>& input) {
    const auto velocity = velocity_block(model, state, input);
    return energy(model, state, velocity, momenta_block(model, state, input, velocity));
}

void run_to_end(Simulation& simulation) {
    while (!simulation.finished()) {
        const auto end = simulation.advance();
        if (end) FAIL() << end->message;
    }
}

}  // namespace hamilcar::test
