#include "hamilcar/analysis/linear_model.hpp"

#include <fmt/format.h>

#include <cmath>
#include <complex>

#include "hamilcar/analysis/loops.hpp"
#include "hamilcar/block/equilibrium.hpp"
#include "hamilcar/block/initial_process.hpp"
#include "hamilcar/math/dense.hpp"

namespace hamilcar {

namespace {

constexpr double steady_accuracy = 1e-9;  // of z', per weight where forces are meant, and of what is asked for

// The linear damper with the mean of the slopes on both sides of rest.
DamperDescription mean_about_rest(const DamperDescription& d) {
    if (d.velocity.size() < 2) return d;
    const auto slope_at = [&](double velocity) {
        std::size_t i = 1;
        while (i + 1 < d.velocity.size() && d.velocity[i] < velocity) ++i;
        return (d.force[i] - d.force[i - 1]) / (d.velocity[i] - d.velocity[i - 1]);
    };
    constexpr double aside = 1e-9;  // [m/s]
    const double mean = 0.5 * (slope_at(-aside) + slope_at(aside));
    return {{-1, 1}, {-mean, mean}};
}

// What an exact linearization is of: dampers without a kink at rest, and a torque at the wheels in place of power units.
VehicleDescription for_linearizing(VehicleDescription vehicle) {
    vehicle.power_units.clear(), vehicle.differentials.clear();
    for (SuspensionDescription& suspension : vehicle.suspensions) {
        for (SuspensionDamperDescription& damper : suspension.dampers) damper.damper = mean_about_rest(damper.damper);
    }
    return vehicle;
}

}  // namespace

Linearizer::Linearizer(const VehicleDescription& vehicle, const Point* seat)
    : vehicle_(for_linearizing(vehicle)),
      seat_(seat ? *seat : vehicle.chassis.center_of_mass),
      model_{.vehicle = Vehicle<double>(vehicle_), .road = PlaneRoad<double>(0, 0, 1)},
      reduced_(vehicle_) {}

OperatingPoint Linearizer::at_rest() const {
    OperatingPoint out;
    out.state = design_state(model_, Vec3<double>::Zero(), Mat3<double>::Identity());
    const AssemblyResult assembly = assemble(model_, out.input.rack, out.state);
    if (!assembly.assembled) {
        out.problem = assembly_problem(vehicle_, model_, assembly.worst);
        return out;
    }
    const EquilibriumResult settled = settle(model_, out.input, out.state);
    out.found = settled.found;
    out.residual = settled.residual;
    if (!settled.found)
        out.problem =
            fmt::format("the vehicle does not settle on the road: {:.3g} N or N m stay unbalanced", settled.residual);
    set_velocities(model_, out.input, Spatial<double>::Zero(), out.state);
    const std::vector<double> z = reduced_from(reduced_, out.state);
    out.z = Eigen::Map<const Eigen::VectorXd>(z.data(), static_cast<Eigen::Index>(z.size()));
    return out;
}

namespace {

// What is left of z' = 0, the speed and the lateral acceleration; forces and moments per weight, so that each counts alike.
Eigen::VectorXd left_over(const LinearModel& m, const Operation& wanted, double weight) {
    Eigen::VectorXd r(m.rate.size() + 2);
    r << m.rate, m.output[output_speed] - wanted.speed,
        m.output[output_speed] * m.output[output_yaw_rate] - wanted.lateral_acceleration;
    for (std::size_t i = 0; i < m.states.size(); ++i) {
        if (is_momentum(m.state_kinds[i])) r[static_cast<Eigen::Index>(i)] /= weight;
    }
    return r;
}

}  // namespace

// One Newton step, shortened until it helps; what is left then. Negative where no step helps.
double Linearizer::improve(OperatingPoint& at) const {
    const double weight = model_.vehicle.total_mass * model_.vehicle.gravity;
    const LinearModel m = linearize(at);
    const Eigen::Index n = m.rate.size();
    Eigen::MatrixXd jacobian(n + 2, n + 2);
    const auto C = [&](LinearOutput output) { return m.C.row(output); };
    const double speed = m.output[output_speed], yaw_rate = m.output[output_yaw_rate];
    jacobian << m.A, m.B.col(rack), m.B.col(drive_torque),  //
        C(output_speed), m.D(output_speed, rack), m.D(output_speed, drive_torque),
        speed * C(output_yaw_rate) + yaw_rate * C(output_speed), speed * m.D(output_yaw_rate, rack),
        speed * m.D(output_yaw_rate, drive_torque);
    const Eigen::VectorXd r = left_over(m, at.operation, weight);
    if (r.norm() < steady_accuracy) return r.norm();
    Eigen::VectorXd unscaled = r;
    unscaled.head(n) = m.rate;
    const Eigen::VectorXd step = solve(jacobian, unscaled);
    at.residual = m.rate.cwiseAbs().maxCoeff();
    for (double share = 1; share > 1e-3; share /= 2) {
        OperatingPoint next = at;
        next.z -= share * step.head(n);
        next.input.rack.displacement -= share * step[n];
        next.input.drive_torque -= share * step[n + 1];
        const LinearModel there = linearize(next);
        const Eigen::VectorXd left = left_over(there, at.operation, weight);
        if (!(left.norm() < r.norm())) continue;
        at = next;
        at.residual = there.rate.cwiseAbs().maxCoeff();
        return left.norm();
    }
    return -1;
}

OperatingPoint Linearizer::operating_point(const Operation& operation) const {
    OperatingPoint at = at_rest();
    at.operation = operation;
    if (!at.found || operation.speed == 0) return at;
    set_velocities(model_, at.input, spatial<double>({operation.speed, 0, 0}, Vec3<double>::Zero()), at.state);
    const std::vector<double> z = reduced_from(reduced_, at.state);
    at.z = Eigen::Map<const Eigen::VectorXd>(z.data(), static_cast<Eigen::Index>(z.size()));
    const LinearModel straight = linearize(at);
    if (straight.B.col(drive_torque).isZero())
        at.found = false, at.problem = "no axle is driven: nothing keeps the speed";
    if (straight.B.col(rack).isZero()) at.found = false, at.problem = "no axle is steered: nothing keeps the course";
    if (!at.found) return at;
    constexpr double lead = 1.0;  // [m/s^2] of lateral acceleration at a time
    const int stages = 1 + static_cast<int>(std::ceil(std::abs(operation.lateral_acceleration) / lead));
    for (int stage = 0; stage < stages; ++stage) {
        at.operation.lateral_acceleration = stages == 1 ? 0 : operation.lateral_acceleration * stage / (stages - 1);
        constexpr int max_iterations = 30;
        double left = 1;
        at.found = false;
        for (int i = 0; i < max_iterations && left > 0 && !at.found; ++i) {
            left = improve(at);
            at.found =
                at.found || (left >= 0 && left < steady_accuracy);  // once there, round-off may leave nothing to gain
        }
        if (!at.found) {
            at.problem = fmt::format(
                "no steady motion found at a lateral acceleration of {:.2f} m/s^2: it may be beyond the tires, or a "
                "wheel lifts",
                at.operation.lateral_acceleration);
            break;
        }
    }
    at.operation = operation;
    const double travel = vehicle_.steering.rack_travel, displacement = at.input.rack.displacement;
    if (at.found && travel > 0 && std::abs(displacement) > travel) {
        at.found = false;
        at.problem = fmt::format("the rack would stand at {:.1f} mm, beyond its travel of {:.1f} mm",
                                 1e3 * displacement, 1e3 * travel);
    }
    at.state = state_of<double>(model_, reduced_, at.z.data(), at.state, at.input.rack);
    return at;
}

std::vector<std::complex<double>> frequency_response(const LinearModel& m, int output, int input, int rate_input,
                                                     const std::vector<double>& frequencies) {
    std::vector<std::complex<double>> out;
    const Eigen::Index n = m.A.rows();
    for (const double w : frequencies) {
        const std::complex<double> s(0, w);
        Eigen::VectorXcd b = m.B.col(input).cast<std::complex<double>>();
        std::complex<double> through = m.D(output, input);
        if (rate_input >= 0) {
            b += s * m.B.col(rate_input).cast<std::complex<double>>();
            through += s * m.D(output, rate_input);
        }
        const Eigen::MatrixXcd K = s * Eigen::MatrixXcd::Identity(n, n) - m.A.cast<std::complex<double>>();
        out.push_back((m.C.row(output).cast<std::complex<double>>() * solve(K, b))(0) + through);
    }
    return out;
}

}  // namespace hamilcar
