// A mechanism: a spoke composed of parts whose hub stands still, so that published mechanisms run through the program
// that moves a car's suspensions. The blocks, the integrator and the closing of the loops after each step are the
// production code; only the 6x6 system of the hub is left out, since v_hub = 0 is given.
#pragma once

#include "hamilcar/block/integration.hpp"

namespace hamilcar::test {

// One freedom: the coordinate `independent` of the linkage, here called the crank's angle, zero at design.
class FixedHub {
public:
    // Gravity in vehicle axes [m/s^2]; step [s].
    FixedHub(const ComposedSpokeDescription& mechanism, const Vec3<double>& gravity, double step,
             std::string_view method = "rk4")
        : gravity_(gravity), step_(step) {
        model_.vehicle.composed.push_back(make_composed<double>(mechanism, hub_size, 0));
        size_ = hub_size + composed_size(spoke());
        integrator_.emplace(*find_method(method), step, size_);
    }
    const ComposedSpoke<double>& spoke() const { return model_.vehicle.composed[0]; }

    // The crank there, the loops closed from where they are: a turn is made of steps that Newton follows.
    void place(double angle) {
        *numbers().independent = angle;
        close_loops(model_, {}, state_, 8);
    }
    // Where the crank stands, at rest or turning [rad/s].
    void start(double angle, double rate) {
        place(angle);
        steps_ = 0;
        integrator_->restart();
        *numbers().momentum = rate / velocities().spokes[0].own.m_inverse(0, 0);  // (59), X = 0: the loops are closed
    }
    void advance() {
        RingTurn<double> first, further;
        int turns = 0;
        const auto rate_at = [&](double, const State<double>& at, State<double>& rate) {
            turn_ring(at, rate, turns++ == 0 ? first : further);
        };
        integrator_->advance(rate_at, time(), state_, state_);
        add_closing(model_, first, state_);
        violation_ = std::max(violation_, first.health.violation);
        ++steps_;
    }
    void run_to(double end) {
        while (time() < end - step_ / 2) advance();
    }

    double time() const { return steps_ * step_; }
    double angle() const { return *numbers().independent; }
    double rate() const { return velocities().spokes[0].own.V_rate[0]; }
    // Of coordinate k: what it is, and its rate.
    double coordinate(int k) const {
        const auto& dependent = spoke().linkage.dependent;
        const auto at = std::find(dependent.begin(), dependent.end(), k);
        return at == dependent.end() ? angle() : numbers().dependent[at - dependent.begin()];
    }
    double coordinate_rate(int k) const {
        const ComposedVelocity<double> at = velocities().spokes[0];
        return at.at.follow[static_cast<std::size_t>(k)][0] * at.own.V_rate[0];
    }
    // From design to now, of body i; vehicle axes.
    Pose<double> pose(std::size_t i) const {
        ComposedPosition<double> at;
        spoke().linkage.find_loops(numbers().independent, numbers().dependent, {}, at);
        return at.pose[static_cast<std::size_t>(spoke().bodies[i].frame)].pose();
    }
    double violation() const { return violation_; }  // largest |Phi| met [m]

    // Kinetic, of weight and of springs [J].
    double energy() const {
        const ComposedVelocity<double> at = velocities().spokes[0];
        double sum = 0;
        for (std::size_t i = 0; i < spoke().bodies.size(); ++i) {
            const Spatial<double>& motion = at.motion[static_cast<std::size_t>(spoke().bodies[i].frame)].pose();
            sum += 0.5 * motion.dot(at.inertia[i] * motion) - at.inertia[i].moment.dot(gravity_);
        }
        for (const ComposedSpring<double>& s : spoke().springs) {
            const auto n = numbers();
            sum += s.spring.potential(spoke().linkage.line(s.line, at.at, n.independent, n.dependent).length);
        }
        return sum;
    }

private:
    ComposedState<double> numbers() { return spoke().state(state_.values.data()); }
    ComposedState<const double> numbers() const { return spoke().state(state_.values.data()); }

    ComposedVelocities<double> velocities(const State<double>& at, Health<double>& health) const {
        ComposedVelocities<double> out;
        condense_composed(model_, at, RackMotion<double>{}, out, health);
        move_composed<double>(model_.vehicle, Spatial<double>::Zero(), out);
        return out;
    }
    ComposedVelocities<double> velocities() const {
        Health<double> health;
        return velocities(state_, health);
    }

    // The ring without its hub.
    void turn_ring(const State<double>& at, State<double>& rate, RingTurn<double>& turn) const {
        turn.health = {};
        const ComposedVelocities<double> velocity = velocities(at, turn.health);
        const Surroundings<double> still{{Vec3<double>::UnitZ(), 0, 1}, gravity_, Spatial<double>::Zero(), 0};
        ComposedMomentaOfAll<double> momenta;
        const Mat3<double> upright = Mat3<double>::Identity();
        Spatial<double> external = Spatial<double>::Zero();
        double work = 0;
        const std::array<double, max_composed_wheels>* no_shafts = nullptr;
        composed_momenta(model_, at, Input<double>{}, velocity, upright, still, no_shafts, momenta, external, work);
        std::fill_n(rate.values.begin(), hub_size, 0.0);
        write_composed_rates(model_.vehicle, velocity, momenta, rate);
        turn.composed_closing[0] = velocity.spokes[0].at.closing;
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
