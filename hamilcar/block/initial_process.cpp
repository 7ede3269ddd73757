#include "hamilcar/block/initial_process.hpp"

#include "hamilcar/block/integration.hpp"

namespace hamilcar {

LoopReport inspect_loops(const Model<double>& model, const RackMotion<double>& rack, const State<double>& state,
                         int spoke) {
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
                report.mobility = std::abs(at.determinant) / Phi_w.rowwise().norm().prod();
                if (!std::isfinite(report.mobility)) report.mobility = 0;
            }
        },
        model.vehicle.spokes[spoke].suspension);
    return report;
}

AssemblyResult assemble(const Model<double>& model, const RackMotion<double>& rack, State<double>& state) {
    constexpr int max_newton_steps = 50;
    close_loops(model, rack, state, max_newton_steps);
    AssemblyResult result;
    for (int i = 0; i < model.vehicle.spoke_count(); ++i) {
        const LoopReport report = inspect_loops(model, rack, state, i);
        const bool closed = report.opening <= assembly_tolerance && report.mobility > locked_mobility;
        if (!closed) return {false, report};
        if (result.worst.cut < 0 || report.opening > result.worst.opening) result.worst = report;
    }
    return result;
}

State<double> design_state(const Model<double>& model, const Vec3<double>& position, const Mat3<double>& R_GC) {
    State<double> state;
    state.position() = position;
    if (model.chart == ChassisChart::quaternion) {
        const Eigen::Quaterniond q(R_GC);
        state.orientation() << q.w(), q.x(), q.y(), q.z();
    } else {
        state.orientation() << bryant_angles(R_GC), 0;
    }
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

void set_velocities(const Model<double>& model, const Input<double>& input, const Spatial<double>& v_1,
                    State<double>& state) {
    const Velocity<double> velocity = velocity_block(model, state, input);
    const RoadPlane<double> road = model.road.seen_from(state.position(), velocity.R_GC);
    Spatial<double> total = model.vehicle.chassis_inertia * v_1;
    for (int i = 0; i < model.vehicle.spoke_count(); ++i) {
        visit_spoke(model.vehicle, velocity, i, [&](const Spoke<double>& spoke, const auto&, const auto& at) {
            const SpokeState<double> to = state.spoke(i);
            const Spatial<double> motion = v_1 + at.position.x;
            const auto [radius, rolling_radius] =
                std::visit([](const auto& tire) { return std::pair(tire.radius, tire.rolling_radius); }, spoke.tire);
            const auto f = contact_frame<double>(road, at.wheel_center, at.spin_axis, radius);
            const double rolling =
                f.longitudinal.dot(velocity_at<double>(motion, f.point)) + f.lever * at.spin_axis.dot(angular(motion));
            to.spin_momentum = spoke.wheel.spin_inertia * rolling / rolling_radius;
            Spatial<double> h = at.inertia * motion;
            h.tail<3>() += at.spin_axis * to.spin_momentum;
            const auto P = (at.position.J.transpose() * h).eval();  // (57)
            for (int j = 0; j < P.size(); ++j) to.momentum[j] = P[j];
            total += h;
        });
    }
    const Spatial<double> ground = spatial<double>(velocity.R_GC * total.head<3>(), velocity.R_GC * total.tail<3>());
    with_chart(model, [&](auto chart) {
        const Vector<double, 4> orientation = state.orientation();
        state.momentum() = chart.stored_momentum(orientation, ground);
    });
}

}  // namespace hamilcar
