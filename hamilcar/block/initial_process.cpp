#include "hamilcar/block/initial_process.hpp"

#include <Eigen/Dense>

#include "hamilcar/block/integration.hpp"
#include "hamilcar/block/road_wheels.hpp"

namespace hamilcar {

namespace {

// |det| over the product of the rows' norms, and the row that depends most on the others.
void inspect_mobility(const Eigen::MatrixXd& Phi_w, double determinant, LoopReport& report) {
    report.mobility = std::abs(determinant) / Phi_w.rowwise().norm().prod();
    if (!std::isfinite(report.mobility)) report.mobility = 0;
    if (!Phi_w.allFinite()) return;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(Phi_w, Eigen::ComputeThinU);
    svd.matrixU().col(Phi_w.cols() - 1).cwiseAbs().maxCoeff(&report.locking);
}

LoopReport inspect_composed(const Model<double>& model, const RackMotion<double>& rack, const State<double>& state,
                            int number) {
    LoopReport report{.spoke = number};
    const auto& spoke = model.vehicle.composed[static_cast<std::size_t>(number - model.vehicle.spoke_count())];
    const auto view = spoke.state(state.values.data());
    ComposedPosition<double> at;
    spoke.linkage.find_position(view.independent, view.dependent, rack, 0.0, at);
    for (int e = 0; e < spoke.linkage.nW(); ++e) {
        const double opening = spoke.linkage.opening(e, at);
        if (report.cut < 0 || !(opening <= report.opening)) report.cut = e, report.opening = opening;
    }
    const int n = spoke.linkage.nW();
    if (n > 0) {
        inspect_mobility(at.Phi_w_inverse.topLeftCorner(n, n).inverse(), at.determinant, report);
    }
    return report;
}

}  // namespace

LoopReport inspect_loops(const Model<double>& model, const RackMotion<double>& rack, const State<double>& state,
                         int spoke) {
    if (spoke >= model.vehicle.spoke_count()) return inspect_composed(model, rack, state, spoke);
    LoopReport report{.spoke = spoke};
    std::visit(
        [&](const auto& suspension) {
            using Linkage = typename std::decay_t<decltype(suspension)>::Linkage;
            const auto view = state.spoke(spoke);
            const auto at = suspension.linkage.position(view.independent, view.dependent, rack, 0.0);
            int cut = 0;
            suspension.linkage.visit_cuts([&](const auto& joint, int, int) {
                const double opening = joint.opening(at.pose.point(joint.tip), rack.displacement);
                if (report.cut < 0 || !(opening <= report.opening)) report.cut = cut, report.opening = opening;
                ++cut;
            });
            if constexpr (Linkage::nW > 0) {
                const auto Phi_w = inverse<double>(at.Phi_w_inverse).matrix;
                inspect_mobility(Phi_w, at.determinant, report);
                int number = 0, of_row = report.locking;
                suspension.linkage.visit_cuts([&](const auto& joint, int row, int) {
                    if (of_row >= row && of_row < row + std::decay_t<decltype(joint)>::equations)
                        report.locking = number;
                    ++number;
                });
            }
        },
        model.vehicle.spokes[spoke].suspension);
    return report;
}

AssemblyResult assemble(const Model<double>& model, const RackMotion<double>& rack, State<double>& state) {
    constexpr int max_newton_steps = 50;
    close_loops(model, rack, state, max_newton_steps);
    AssemblyResult result;
    for (int i = 0; i < loop_count(model.vehicle); ++i) {
        const LoopReport report = inspect_loops(model, rack, state, i);
        const bool closed = report.opening <= assembly_tolerance && report.mobility > locked_mobility;
        if (!closed) return {false, report};
        if (result.worst.cut < 0 || report.opening > result.worst.opening) result.worst = report;
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

State<double> design_state(const Model<double>& model, const Vec3<double>& position, const Mat3<double>& R_GC) {
    State<double> state;
    place_chassis(model, position, R_GC, state);
    for (int i = 0; i < model.vehicle.spoke_count(); ++i) {
        std::visit(
            [&](const auto& suspension) {
                for (std::size_t j = 0; j < suspension.design.size(); ++j) {
                    state.spoke(i).independent[j] = suspension.design[j];
                }
            },
            model.vehicle.spokes[i].suspension);
    }
    return state;
}

namespace {

// Spin with which a wheel rolls along without slip, its carrier moving with `motion` [rad/s].
double rolling_spin(const ContactFrame<double>& f, const Vec3<double>& axis, const Tire<double>& tire,
                    const Spatial<double>& motion) {
    const double rolling =
        f.longitudinal.dot(velocity_at<double>(motion, f.point)) + f.lever * axis.dot(angular(motion));
    return rolling / rolling_radius(tire);
}

// Momenta of composed suspensions and hitches while nothing moves against its hub; their total, about the chassis origin.
Spatial<double> set_composed_velocities(const Model<double>& model, const Velocity<double>& velocity,
                                        const Momenta<double>& momenta, const Spatial<double>& v_1,
                                        State<double>& state) {
    const Vehicle<double>& vehicle = model.vehicle;
    std::vector<Spatial<double>> motion{v_1};
    std::vector<Spatial<double>> total{Spatial<double>::Zero()};
    for (std::size_t i = 0; i < vehicle.trailers.size(); ++i) {
        const auto tow = static_cast<std::size_t>(vehicle.trailers[i].tow);
        motion.push_back(seen_from<double>(velocity.composed.trailers[i].pose, motion[tow]));
        total.push_back(vehicle.trailers[i].chassis_inertia * motion.back());
    }
    for (std::size_t s = 0; s < vehicle.composed.size(); ++s) {
        const ComposedSpoke<double>& spoke = vehicle.composed[s];
        const ComposedVelocity<double>& at = velocity.composed.spokes[s];
        const auto unit = static_cast<std::size_t>(spoke.unit);
        const auto to = spoke.state(state.values.data());
        for (int j = 0; j < spoke.linkage.nV(); ++j) to.momentum[j] = 0;
        const auto add = [&](int frame, const Spatial<double>& h) {
            for (int j = 0; j < spoke.linkage.nV(); ++j) {
                to.momentum[j] += at.at.motion.J[static_cast<std::size_t>(frame)].col(j).dot(h);  // (57)
            }
            total[unit] += h;
        };
        const auto motion_of = [&](int frame) -> Spatial<double> {
            return motion[unit] + at.at.motion.x[static_cast<std::size_t>(frame)];
        };
        for (std::size_t i = 0; i < spoke.bodies.size(); ++i) {
            const int frame = spoke.bodies[i].frame;
            add(frame, at.inertia[i] * motion_of(frame));
        }
        for (std::size_t i = 0; i < spoke.wheels.size(); ++i) {
            const ComposedWheel<double>& wheel = spoke.wheels[i];
            const double spin = rolling_spin(momenta.composed.spokes[s].wheels[i].frame, at.axis[i], wheel.tire,
                                             motion_of(wheel.frame));
            double& p_s = spoke.wheel_state(static_cast<int>(i), state.values.data()).spin_momentum;
            p_s = wheel.wheel.spin_inertia * spin;
            add(wheel.frame, spatial<double>(Vec3<double>::Zero(), at.axis[i] * p_s));
        }
    }
    for (std::size_t i = vehicle.trailers.size(); i-- > 0;) {
        const Trailer<double>& trailer = vehicle.trailers[i];
        const TrailerVelocity<double>& at = velocity.composed.trailers[i];
        const Spatial<double> h = carried_over<double>(at.pose, total[i + 1]);
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
    Spatial<double> total = model.vehicle.chassis_inertia * v_1;
    for (int i = 0; i < model.vehicle.spoke_count(); ++i) {
        visit_spoke(model.vehicle, velocity, i, [&](const Spoke<double>& spoke, const auto&, const auto& at) {
            const SpokeState<double> to = state.spoke(i);
            const Spatial<double> motion = v_1 + at.position.x;
            const ContactFrame<double>& f = momenta.spokes[static_cast<std::size_t>(i)].forces.frame;
            to.spin_momentum = spoke.wheel.spin_inertia * rolling_spin(f, at.spin_axis, spoke.tire, motion);
            Spatial<double> h = at.inertia * motion;
            h.tail<3>() += at.spin_axis * to.spin_momentum;
            const auto P = (at.position.J.transpose() * h).eval();  // (57)
            for (int j = 0; j < P.size(); ++j) to.momentum[j] = P[j];
            total += h;
        });
    }
    if (model.vehicle.has_composed()) total += set_composed_velocities(model, velocity, momenta, v_1, state);
    const Spatial<double> ground = spatial<double>(velocity.R_GC * total.head<3>(), velocity.R_GC * total.tail<3>());
    with_chart(model, [&](auto chart) {
        const Vector<double, 4> orientation = state.orientation();
        state.momentum() = chart.stored_momentum(orientation, ground);
    });
}

}  // namespace hamilcar
