// A mechanism: a suspension on a fixed base, so that published mechanisms run through the code that moves a car's
// suspensions. The blocks, the integrator and the Newton correction after each step are the production code; only the 6x6
// system of the chassis is left out, since v_1 = 0 is given.
#pragma once

#include "hamilcar/block/integration.hpp"

namespace hamilcar::test {

// One degree of freedom: the coordinate `independent` of the linkage, here called the crank's angle, zero at design.
class FixedBase {
public:
    // Gravity in vehicle axes [m/s^2]; step [s].
    FixedBase(const SuspensionDescription& mechanism, const Vec3<double>& gravity, double step,
              std::string_view method = "rk4")
        : gravity_(gravity), step_(step) {
        VehicleDescription vehicle;
        vehicle.suspensions = {mechanism};
        const StateLayout layout(vehicle);
        model_.vehicle.suspensions.push_back(make_suspension<double>(mechanism, layout.suspension(0), 0));
        size_ = layout.size();
        integrator_.emplace(*find_method(method), step, size_);
    }
    const Suspension<double>& suspension() const { return model_.vehicle.suspensions[0]; }

    // Moves the crank and closes the loops from their present position: a revolution needs steps small enough for Newton.
    void place(double angle) {
        *numbers().independent = angle;
        close_loops(model_, {}, state_, 8);
    }
    // Sets the crank's angle [rad] and rate [rad/s].
    void start(double angle, double rate) {
        place(angle);
        steps_ = 0;
        integrator_->restart();
        *numbers().momentum = rate / velocity().own.m_inverse(0, 0);  // (59), X = 0: the loops are closed
    }
    void advance() {
        Evaluation<double> first, further;
        int evaluations = 0;
        const auto rate_at = [&](double, const State<double>& at, State<double>& rate) {
            evaluate(at, rate, evaluations++ == 0 ? first : further);
        };
        integrator_->advance(rate_at, time(), state_, state_);
        add_correction(model_, first, state_);
        violation_ = std::max(violation_, first.health.violation);
        ++steps_;
    }
    void run_to(double end) {
        while (time() < end - step_ / 2) advance();
    }

    double time() const { return steps_ * step_; }
    double angle() const { return *numbers().independent; }
    double rate() const { return velocity().own.V_rate[0]; }
    // Coordinate k and its rate.
    double coordinate(int k) const {
        const auto& dependent = suspension().linkage.dependent;
        const auto at = std::find(dependent.begin(), dependent.end(), k);
        return at == dependent.end() ? angle() : numbers().dependent[at - dependent.begin()];
    }
    double coordinate_rate(int k) const {
        const SuspensionVelocity<double> at = velocity();
        return at.at.Y[static_cast<std::size_t>(k)][0] * at.own.V_rate[0];
    }
    // Of body i relative to design; vehicle axes.
    Pose<double> pose(std::size_t i) const {
        LinkagePosition<double> at;
        suspension().linkage.find_loops(numbers().independent, numbers().dependent, {}, at);
        return at.pose[static_cast<std::size_t>(suspension().bodies[i].frame)].pose();
    }
    double violation() const { return violation_; }  // largest |Phi| met [m]

    // Kinetic, of weight and of springs [J].
    double energy() const {
        const SuspensionVelocity<double> at = velocity();
        double sum = 0;
        for (std::size_t i = 0; i < suspension().bodies.size(); ++i) {
            const Spatial<double>& motion = at.motion[static_cast<std::size_t>(suspension().bodies[i].frame)];
            sum += 0.5 * motion.dot(at.inertia[i] * motion) - at.inertia[i].first_moment.dot(gravity_);
        }
        for (const SuspensionSpring<double>& s : suspension().springs) {
            const auto n = numbers();
            sum += s.spring.potential(suspension().linkage.line(s.line, at.at, n.independent, n.dependent).length);
        }
        return sum;
    }

private:
    SuspensionState<double> numbers() { return suspension().state(state_.values.data()); }
    SuspensionState<const double> numbers() const { return suspension().state(state_.values.data()); }

    Velocity<double> velocity_at(const State<double>& at) const {
        Velocity<double> out;
        out.R_GC.setIdentity(), out.chassis.setZero();
        condense_suspensions(model_, at, out);
        move_suspensions(model_.vehicle, out);
        return out;
    }
    SuspensionVelocity<double> velocity() const { return velocity_at(state_).suspensions[0]; }

    // The right-hand side without the chassis.
    void evaluate(const State<double>& at, State<double>& rate, Evaluation<double>& out) const {
        const Velocity<double> velocity = velocity_at(at);
        const Surroundings<double> still{{Vec3<double>::UnitZ(), 0, 1}, gravity_, Spatial<double>::Zero(), 0};
        Momenta<double> momenta;
        momenta.external.setZero(), momenta.work_rate = 0;
        suspension_momenta(model_, at, Input<double>{}, velocity, still, {}, momenta);
        std::fill_n(rate.values.begin(), chassis_size, 0.0);
        write_suspension_rates(model_.vehicle, velocity, momenta, rate);
        report_evaluation(model_, velocity, out);
    }

    Model<double> model_;
    Vec3<double> gravity_;
    double step_;
    int size_ = 0;
    long steps_ = 0;
    double violation_ = 0;
    State<double> state_;
    std::optional<Integrator<State<double>>> integrator_;
};

}  // namespace hamilcar::test
