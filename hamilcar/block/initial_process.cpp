#include "hamilcar/block/initial_process.hpp"

#include "hamilcar/block/integration.hpp"
#include "hamilcar/block/road_wheels.hpp"
#include "hamilcar/math/dense.hpp"

namespace hamilcar {

namespace {

// |det| over the product of the rows' norms, and the row that depends most on the others.
void inspect_mobility(const Eigen::MatrixXd& Phi_w, double determinant, LoopReport& report) {
    report.mobility = std::abs(determinant) / Phi_w.rowwise().norm().prod();
    if (!std::isfinite(report.mobility)) report.mobility = 0;
    if (!Phi_w.allFinite()) return;
    last_left_singular_vector(Phi_w).cwiseAbs().maxCoeff(&report.nearly_redundant);
}

}  // namespace

LoopReport inspect_loops(const Model<double>& model, const RackMotion<double>& rack, const State<double>& state,
                         int number) {
    LoopReport report{.suspension = number};
    const auto& suspension = model.vehicle.suspensions[static_cast<std::size_t>(number)];
    const auto view = suspension.state(state.values.data());
    LinkagePosition<double> at;
    suspension.linkage.find_position(view.independent, view.dependent,
                                     rack_at(model.vehicle, suspension, rack, state.values.data()), 0.0, at);
    for (int e = 0; e < suspension.linkage.nW(); ++e) {
        const double violation = suspension.linkage.violation(e, at);
        if (report.cut < 0 || !(violation <= report.violation)) report.cut = e, report.violation = violation;
    }
    const int n = suspension.linkage.nW();
    if (n > 0) {
        inspect_mobility(inverse(at.Phi_w_inverse.topLeftCorner(n, n)), at.determinant, report);
    }
    return report;
}

AssemblyResult assemble(const Model<double>& model, const RackMotion<double>& rack, State<double>& state) {
    constexpr int max_newton_steps = 50;
    close_loops(model, rack, state, max_newton_steps);
    AssemblyResult result;
    for (int i = 0; i < static_cast<int>(model.vehicle.suspensions.size()); ++i) {
        const LoopReport report = inspect_loops(model, rack, state, i);
        const bool closed = report.violation <= assembly_tolerance && report.mobility > locked_mobility;
        if (!closed) return {false, report};
        if (result.worst.cut < 0 || report.violation > result.worst.violation) result.worst = report;
    }
    return result;
}

void place_chassis(const Model<double>& model, const Vec3<double>& position, const Mat3<double>& R_GC,
                   State<double>& state) {
    state.position() = position;
    if (model.chart == ChassisChart::quaternion) {
        const Eigen::Quaterniond q(R_GC);
        state.orientation() << q.w(), q.x(), q.y(), q.z();
    } else {
        state.orientation() << bryant_angles(R_GC), 0;
    }
}

void hold_pedal(const Model<double>& model, double command, State<double>& state) {
    const BrakeSystem<double>& brakes = model.vehicle.brakes;
    double* values = state.values.data();
    const double pressure = brakes.pedal_pressure.at(command);
    for (std::size_t unit = 0; unit < brakes.source.size(); ++unit) brakes.control(unit, values) = pressure;
    for (std::size_t i = 0; i < brakes.lines.size(); ++i) {
        brakes.pressure(i, values) = brakes.lines[i].supply(pressure);
    }
}

void hold_inputs(const Model<double>& model, const Input<double>& input, State<double>& state) {
    hold_pedal(model, input.brake, state);
    const BrakeSystem<double>& brakes = model.vehicle.brakes;
    double* values = state.values.data();
    for (std::size_t i = 0; i < brakes.lines.size(); ++i) brakes.temperature(i, values) = ambient_temperature;
    for (std::size_t i = 0; i < model.vehicle.actuators.size(); ++i) {
        values[model.vehicle.actuator_place + static_cast<int>(i)] = model.vehicle.actuators[i].rest;
    }
    for (const AxleSteer<double>& one : model.vehicle.axle_steers) values[one.place] = values[one.place + 1] = 0;
    const Battery<double>& battery = model.vehicle.powertrain.battery;
    if (battery.exists()) {
        const auto at = battery.state(values);
        at.charge = battery.initial_charge, at.voltage = battery.open_voltage.at(battery.initial_charge);
    }
    const SteeringSystem<double>& steering = model.vehicle.steering;
    if (!steering.exists()) return;
    const auto at = steering.state(values);
    at.rack = input.rack.displacement;
    const double pinion = steering.pinion_at(at.rack).angle;
    at.wheel = pinion;
    constexpr int rounds = 30;  // joints that are bent turn the column by a little: to the last bit
    for (int i = 0; i < rounds; ++i) at.wheel += pinion - steering.lower_end(at.wheel).angle;
    at.rack_momentum = at.wheel_momentum = at.rack_windup = at.wheel_windup = at.assist = 0;
}

State<double> design_state(const Model<double>& model, const Vec3<double>& position, const Mat3<double>& R_GC) {
    State<double> state;
    place_chassis(model, position, R_GC, state);
    hold_inputs(model, Input<double>{}, state);
    return state;
}

namespace {

// Spin at which a wheel rolls without slip while its carrier moves with `motion` [rad/s].
double rolling_spin(const ContactFrame<double>& f, const Vec3<double>& axis, const Tire<double>& tire,
                    const Spatial<double>& motion) {
    const double rolling =
        f.longitudinal.dot(velocity_at<double>(motion, f.point)) + f.lever * axis.dot(angular(motion));
    return rolling / rolling_radius(tire);
}

// Sets the momenta of suspensions and hitches while nothing moves relative to its chassis; returns the vehicle's, about the
// chassis origin.
Spatial<double> set_momenta(const Model<double>& model, const Velocity<double>& velocity,
                            const Momenta<double>& momenta, const Spatial<double>& v_1, State<double>& state) {
    const Vehicle<double>& vehicle = model.vehicle;
    std::vector<Spatial<double>> motion{v_1};
    std::vector<Spatial<double>> total{vehicle.chassis_inertia * v_1};
    for (std::size_t i = 0; i < vehicle.trailers.size(); ++i) {
        const auto tow = static_cast<std::size_t>(vehicle.trailers[i].tow);
        motion.push_back(motion_to_frame<double>(velocity.trailers[i].pose, motion[tow]));
        total.push_back(vehicle.trailers[i].chassis_inertia * motion.back());
    }
    const bool rack_is_free = vehicle.steering.exists();  // and at rest
    double rack_momentum = 0;
    for (std::size_t s = 0; s < vehicle.suspensions.size(); ++s) {
        const Suspension<double>& suspension = vehicle.suspensions[s];
        const SuspensionVelocity<double>& at = velocity.suspensions[s];
        const auto unit = static_cast<std::size_t>(suspension.unit);
        const auto to = suspension.state(state.values.data());
        for (int j = 0; j < suspension.linkage.nV(); ++j) to.momentum[j] = 0;
        const auto add = [&](int frame, const Spatial<double>& h) {
            for (int j = 0; j < suspension.linkage.nV(); ++j) {
                to.momentum[j] += at.at.motion.J[static_cast<std::size_t>(frame)].col(j).dot(h);  // (57)
            }
            total[unit] += h;
            if (rack_is_free && suspension.follows_rack())
                rack_momentum += at.at.motion.x[static_cast<std::size_t>(frame)].dot(h);
        };
        const auto motion_of = [&](int frame) -> Spatial<double> {
            const Spatial<double>& by_rack = at.at.motion.x[static_cast<std::size_t>(frame)];
            const bool rests = rack_is_free && suspension.steered_by < 0;
            return rests ? motion[unit] : Spatial<double>(motion[unit] + by_rack);
        };
        for (std::size_t i = 0; i < suspension.bodies.size(); ++i) {
            const int frame = suspension.bodies[i].frame;
            add(frame, at.inertia[i] * motion_of(frame));
        }
        for (std::size_t i = 0; i < suspension.wheels.size(); ++i) {
            const SuspensionWheel<double>& wheel = suspension.wheels[i];
            const double spin =
                rolling_spin(momenta.suspensions[s].wheels[i].frame, at.axis[i], wheel.tire, motion_of(wheel.frame));
            double& p_s = suspension.wheel_state(static_cast<int>(i), state.values.data()).spin_momentum;
            p_s = wheel.wheel.spin_inertia * spin;
            add(wheel.frame, spatial<double>(Vec3<double>::Zero(), at.axis[i] * p_s));
        }
    }
    if (rack_is_free) vehicle.steering.state(state.values.data()).rack_momentum = rack_momentum;
    for (std::size_t i = vehicle.trailers.size(); i-- > 0;) {
        const Trailer<double>& trailer = vehicle.trailers[i];
        const TrailerVelocity<double>& at = velocity.trailers[i];
        const Spatial<double> h = force_to_parent<double>(at.pose, total[i + 1]);
        const int n = trailer.freedoms();
        double* conjugate = state.values.data() + trailer.offset + n;
        for (int j = 0; j < n; ++j) conjugate[j] = at.hitch.motion.J[static_cast<std::size_t>(n)].col(j).dot(h);
        total[static_cast<std::size_t>(trailer.tow)] += h;
    }
    return total[0];
}

}  // namespace

void set_velocities(const Model<double>& model, const Input<double>& input, const Spatial<double>& v_1,
                    State<double>& state) {
    const Velocity<double> velocity = velocity_block(model, state, input);
    const Momenta<double> momenta = momenta_block(model, state, input, velocity);  // for the contacts
    const Spatial<double> total = set_momenta(model, velocity, momenta, v_1, state);
    const Spatial<double> ground = spatial<double>(velocity.R_GC * total.head<3>(), velocity.R_GC * total.tail<3>());
    with_chart(model, [&](auto chart) {
        const Vector<double, 4> orientation = state.orientation();
        state.momentum() = chart.stored_momentum(orientation, ground);
    });
}

}  // namespace hamilcar
