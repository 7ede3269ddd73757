// A vehicle in both engines at once, and how far apart they get.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "oracle/hand_over.hpp"

namespace hamilcar::oracle {

class SideBySide {
public:
    SideBySide(const VehicleDescription& vehicle, const ScenarioDescription& scenario,
               SpindleModel spindle_model = SpindleModel::free)
        : simulation(vehicle, scenario),
          simbody(vehicle, {scenario.road.grade, scenario.road.bank, scenario.road.friction}, spindle_model) {
        simbody.set_inputs(inputs(0));
        simbody.set_state(state_of(simulation));
    }

    // Of every unit at its center of mass, and at a point 1.7 m beside it, which sees the angles as well [m].
    double gap() const {
        const VehicleDescription& vehicle = simulation.vehicle();
        const Sample sample = simulation.sample();
        double largest = 0;
        for (std::size_t unit = 0; unit <= vehicle.trailers.size(); ++unit) {
            const BodyDescription& chassis = unit == 0 ? vehicle.chassis : vehicle.trailers[unit - 1].chassis;
            for (const double beside : {0.0, 1.0}) {
                Point point = chassis.center_of_mass;
                for (double& x : point) x += beside;
                const std::array<double, 3> there = simbody.ground_point(unit, point);
                largest = std::max(largest, (ground_point(sample, unit, point) - Vec3<double>(there.data())).norm());
            }
        }
        return largest;
    }

    // Both take the scenario's step; looks ten times a second.
    double largest_gap() {
        const double step = simulation.scenario().solver.step;
        const int steps = static_cast<int>(std::lround(0.1 / step));
        double largest = gap();
        while (!simulation.finished()) {
            simbody.advance(simulation.time(), step, steps, inputs);
            for (int i = 0; i < steps; ++i) {
                if (const auto end = simulation.advance()) {
                    ADD_FAILURE() << end->message;
                    return largest;
                }
            }
            largest = std::max(largest, gap());
        }
        EXPECT_LT(simbody.worst_constraint_error(), 1e-10);
        return largest;
    }

    Simulation simulation;
    SimbodyCar simbody;
    std::function<Inputs(double)> inputs = inputs_of(simulation);
};

}  // namespace hamilcar::oracle
