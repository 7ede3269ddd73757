#include "hamilcar/batch/topology.hpp"

#include <fmt/format.h>

#include "hamilcar/engine/rhs_trace.hpp"

namespace hamilcar {

namespace {

template <class T>
std::vector<int> shape(const Linkage<T>& linkage) {
    std::vector<int> out = linkage.path;
    for (const auto& f : linkage.coordinates) out.insert(out.end(), {f.slides, f.parent, f.same_point});
    for (const auto& e : linkage.equations) out.insert(out.end(), {e.plane, e.part, e.base});
    out.insert(out.end(), linkage.independent.begin(), linkage.independent.end());
    return out;
}

std::vector<int> shape(const Suspension<double>& suspension) {
    std::vector<int> out = shape(suspension.linkage);
    out.insert(out.end(), {suspension.unit, suspension.steered_by, suspension.shaft_frame});
    for (const auto& body : suspension.bodies) out.push_back(body.frame);
    for (const auto& wheel : suspension.wheels) {
        out.insert(out.end(), {wheel.frame, wheel.tires, wheel.reaction, wheel.bar_arm, wheel.brake.has_parking});
    }
    const auto add = [&](const auto& elements) {
        out.push_back(static_cast<int>(elements.size()));
        for (const auto& element : elements) {
            out.insert(out.end(), {element.line.part, element.line.base, element.line.coordinate});
        }
    };
    add(suspension.springs), add(suspension.dampers);
    for (const auto& damper : suspension.dampers) out.push_back(damper.actuator);
    return out;
}

std::vector<int> shape(const Powertrain<double>& powertrain) {
    std::vector<int> out{static_cast<int>(powertrain.units.size())};
    for (const auto& unit : powertrain.units) {
        out.insert(out.end(),
                   {unit.output, unit.command, static_cast<int>(unit.source.index()),
                    static_cast<int>(unit.gears.ratio.size()), static_cast<int>(unit.converter.capacity.slope.size())});
        out.insert(out.end(), {unit.rotor_is_free, unit.shafts.present, unit.place});
        const auto add = [&out](const CurveFamily<double>& family) {
            out.push_back(static_cast<int>(family.curves.size()));
            for (const auto& curve : family.curves) out.push_back(static_cast<int>(curve.slope.size()));
        };
        if (const auto* engine = std::get_if<CombustionEngine<double>>(&unit.source)) {
            add(engine->torque);
        } else {
            const auto& motor = std::get<ElectricMotor<double>>(unit.source);
            add(motor.torque), add(motor.efficiency_map);
        }
    }
    out.insert(out.end(), {powertrain.battery.present, powertrain.regenerates,
                           static_cast<int>(powertrain.battery.open_voltage.slope.size())});
    for (const auto& differential : powertrain.differentials) {
        out.insert(out.end(), differential.outputs.begin(), differential.outputs.end());
    }
    out.insert(out.end(), powertrain.wheels.begin(), powertrain.wheels.end());
    return out;
}

std::vector<int> shape(const BrakeSystem<double>& brakes) {
    std::vector<int> out{brakes.is_air, static_cast<int>(brakes.pedal_pressure.slope.size())};
    for (const auto& line : brakes.lines) {
        out.insert(out.end(), {line.wheel, line.unit, line.command, static_cast<int>(line.friction.slope.size())});
    }
    return out;
}

std::vector<std::size_t> shape(const SteeringSystem<double>& steering) {
    return {steering.pinion.slope.size(), steering.assist.slope.size(), steering.assist_share.slope.size()};
}

std::string vehicle_difference(const Vehicle<double>& a, const Vehicle<double>& b) {
    if (shape(a.powertrain) != shape(b.powertrain)) return "power units or differentials";
    if (shape(a.brakes) != shape(b.brakes)) return "the brake system";
    if (a.steering.place != b.steering.place || a.steering.has_joints != b.steering.has_joints ||
        shape(a.steering) != shape(b.steering))
        return "the mechanics of the steering";
    if (a.commands != b.commands || a.is_measured != b.is_measured) return "controllers";
    if (a.hull.points.size() != b.hull.points.size()) return "number of hull points";
    if (a.suspensions.size() != b.suspensions.size()) return "number of suspensions";
    for (std::size_t i = 0; i < a.suspensions.size(); ++i) {
        const Suspension<double>&one = a.suspensions[i], &other = b.suspensions[i];
        if (shape(one) != shape(other)) return fmt::format("suspension {}", i + 1);
        for (std::size_t w = 0; w < one.wheels.size(); ++w) {
            if (one.wheels[w].tire.index() != other.wheels[w].tire.index()) {
                return fmt::format("tire model of wheel {}", static_cast<std::size_t>(one.first_wheel) + w + 1);
            }
        }
    }
    if (a.trailers.size() != b.trailers.size()) return "number of trailers";
    for (std::size_t i = 0; i < a.trailers.size(); ++i) {
        if (a.trailers[i].tow != b.trailers[i].tow || shape(a.trailers[i].hitch) != shape(b.trailers[i].hitch)) {
            return fmt::format("hitch of trailer {}", i + 1);
        }
    }
    const auto ends = [](const AntiRollBar<double>& bar) { return std::array{bar.left, bar.right, bar.actuator}; };
    if (!std::ranges::equal(a.anti_roll_bars, b.anti_roll_bars, {}, ends, ends)) return "anti-roll bars";
    return {};
}

// Whether two cars differ in a number that is no parameter.
bool differs_in_constant(const std::vector<int>& parameters, const Model<double>& a, const Model<double>& b) {
    const ModelNumbers one = numbers_of(a), other = numbers_of(b);
    if (one.shape != other.shape || one.numbers.size() != other.numbers.size()) return true;
    std::vector<bool> may_differ(one.numbers.size());
    for (const int parameter : parameters) may_differ[static_cast<std::size_t>(parameter)] = true;
    for (std::size_t i = 0; i < one.numbers.size(); ++i) {
        if (!may_differ[i] && one.numbers[i] != other.numbers[i]) return true;
    }
    return false;
}

}  // namespace

std::vector<int> elimination_order(const Vehicle<double>& vehicle) {
    std::vector<int> out;
    for (const Suspension<double>& suspension : vehicle.suspensions) {
        const Linkage<double>& linkage = suspension.linkage;
        out.insert(out.end(), linkage.pivot_equation.begin(), linkage.pivot_equation.end());
        out.insert(out.end(), linkage.pivot_dependent.begin(), linkage.pivot_dependent.end());
    }
    return out;
}

std::string topology_difference(const Simulation& a, const Simulation& b) {
    const SolverDescription &x = a.scenario().solver, &y = b.scenario().solver;
    if (x.integrator != y.integrator) return "integrator";
    if (x.step != y.step) return "step";
    if (a.model().chart != b.model().chart) return "chart";
    if (a.model().constraints != b.model().constraints) return "constraint mode";
    if (a.model().energy_balance != b.model().energy_balance) return "energy balance";
    return vehicle_difference(a.model().vehicle, b.model().vehicle);
}

std::string program_difference(const Simulation& a, const Simulation& b) {
    const std::string difference = topology_difference(a, b);
    if (!difference.empty()) return difference;
    const bool same_order = elimination_order(a.model().vehicle) == elimination_order(b.model().vehicle);
    return same_order ? "" : "the order in which a linkage's equations are solved";
}

std::string program_difference(const Simulation& a, const Simulation& b, const std::vector<int>& parameters) {
    const std::string difference = program_difference(a, b);
    if (!difference.empty() || !differs_in_constant(parameters, a.model(), b.model())) return difference;
    return "a number that all cars share: the program was made without a variant for it";
}

}  // namespace hamilcar
