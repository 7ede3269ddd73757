// A rack that moves on its own, as a seventh coordinate of the car: against the prescribed rack by the force that holds it on its course,
// and against the momenta and energies of the bodies.
#include <gtest/gtest.h>

#include "hamilcar/analysis/acceleration.hpp"
#include "hamilcar/analysis/rack_force.hpp"
#include "support/difference.hpp"
#include "support/free_steering.hpp"

namespace hamilcar {
namespace {

// Struts, double wishbones, a rigid axle, five axles and a trailer.
class FreeRack : public testing::TestWithParam<std::string> {
protected:
    static VehicleDescription chassis() {
        return GetParam() == "knuckle" ? test::sprung_at_the_knuckle() : test::shipped(GetParam());
    }
    static VehicleDescription car() { return test::with_mechanics(chassis(), test::full_mechanics()); }
};
INSTANTIATE_TEST_SUITE_P(Cars, FreeRack,
                         testing::Values("bmw_323i", "bmw_e90_330i", "formula", "offroader", "truck_semitrailer",
                                         "knuckle"),
                         [](const auto& test) { return test.param; });

// A state and everything that the blocks make of it.
struct Instant {
    const Model<double>& model;
    State<double> state;
    Input<double> input;
    Velocity<double> velocity = velocity_block(model, state, input);
    Momenta<double> momenta = momenta_block(model, state, input, velocity);

    State<double> rate() const {
        State<double> out;
        rate_of_state(model, state, velocity, momenta, out);
        return out;
    }
};

// The same car with a rack that is prescribed.
struct Twin {
    explicit Twin(const Simulation& free) : free_car(free.vehicle()), model(free.model()) {
        prescribed_car.steering.is_free = false;
        model.vehicle = Vehicle<double>(prescribed_car);
        const StateLayout theirs(free_car), own(prescribed_car);
        for (const StateNumber& number : own.numbers()) {
            const auto same = [&](const StateNumber& other) { return other.name == number.name; };
            place.push_back(
                static_cast<std::size_t>(std::ranges::find_if(theirs.numbers(), same) - theirs.numbers().begin()));
        }
    }
    State<double> of(const State<double>& state) const {
        State<double> out;
        for (std::size_t k = 0; k < place.size(); ++k) out.values[k] = state.values[place[k]];
        return out;
    }
    VehicleDescription free_car, prescribed_car = free_car;
    Model<double> model;
    std::vector<std::size_t> place;  // of its numbers among those of the free one
};

TEST_P(FreeRack, MovesAsThePrescribedOneThatIsHeldByTheForceOfItsColumn) {
    Simulation simulation(car(), test::steering_moves(car()));
    const Twin twin(simulation);
    ASSERT_EQ(twin.place.size() + steering_numbers, static_cast<std::size_t>(simulation.model().vehicle.state_size));
    double most = 0, worst = 0, fastest = 0, other = 0;
    while (!simulation.finished()) {
        ASSERT_FALSE(simulation.advance());
        if (simulation.steps_taken() % 97 != 0) continue;
        const Model<double>& model = simulation.model();
        const Instant at{model, simulation.state(), simulation.schedule()(simulation.time())};
        const State<double> rate = at.rate();
        const auto rack_rate = [&](double time) {
            return velocity_block(model, state_after(model, at.state, rate, time), input_after(at.input, time))
                .rack.rate;
        };
        const double acceleration = test::derivative(rack_rate, 0, 1e-4);
        Input<double> input = at.input;
        input.rack = {at.velocity.rack.displacement, at.velocity.rack.rate, acceleration};
        const Instant held{twin.model, twin.of(at.state), input};
        const double force = rack_force(held.model, held.state, held.input, held.velocity, held.momenta);
        const double expected = at.momenta.steering.on_rack - model.vehicle.steering.rack_mass * acceleration;
        most = std::max(most, std::abs(force)), worst = std::max(worst, std::abs(force - expected));
        fastest = std::max(fastest, std::abs(input.rack.rate));
        // All other numbers change as they do there, but for the account of work.
        const State<double> theirs = held.rate(), own = twin.of(rate);
        for (std::size_t k = 0; k < twin.place.size(); ++k) {
            if (&own.values[k] == &own.work()) continue;
            other = std::max(other, std::abs(theirs.values[k] - own.values[k]) / (1 + std::abs(own.values[k])));
        }
    }
    std::printf("%s: up to %.1f N, differs by %.1e N; other rates by %.1e of themselves; rack at up to %.3f m/s\n",
                GetParam().c_str(), most, worst, other, fastest);
    EXPECT_LT(worst, 1e-8 * most);
    EXPECT_LT(other, 1e-9);
    EXPECT_GT(fastest, 0.005);
}

// Half the sum of all momenta times their rates, against the bodies one by one.
TEST_P(FreeRack, HasTheKineticEnergyOfItsMomenta) {
    Simulation simulation(car(), test::steering_moves(car(), 1.3));
    for (int i = 0; i < 1200; ++i) {
        ASSERT_FALSE(simulation.advance());
        if (i % 200 != 7) continue;
        const Sample s = simulation.sample();
        const Vehicle<double>& vehicle = s.model.vehicle;
        const double* values = s.state.values.data();
        const SteeringState<const double> steering = test::steering_state(s.model, s.state);
        double twice = s.velocity.momentum.dot(s.velocity.chassis) + steering.rack_momentum * s.velocity.rack.rate +
                       steering.wheel_momentum * s.momenta.steering.wheel_rate;
        for (std::size_t k = 0; k < vehicle.suspensions.size(); ++k) {
            const Suspension<double>& suspension = vehicle.suspensions[k];
            for (int j = 0; j < suspension.linkage.nV(); ++j) {
                twice += suspension.state(values).momentum[j] *
                         s.velocity.suspensions[k].own.V_rate[static_cast<std::size_t>(j)];
            }
            for (std::size_t w = 0; w < suspension.wheels.size(); ++w) {
                twice += suspension.wheel_state(static_cast<int>(w), values).spin_momentum *
                         s.momenta.suspensions[k].wheels[w].spin;
            }
        }
        for (std::size_t k = 0; k < vehicle.trailers.size(); ++k) {
            const int n = vehicle.trailers[k].freedoms();
            for (int j = 0; j < n; ++j) {
                twice += values[vehicle.trailers[k].offset + n + j] *
                         s.velocity.trailers[k].own.V_rate[static_cast<std::size_t>(j)];
            }
        }
        EXPECT_NEAR(s.energy.kinetic, twice / 2, 1e-11 * s.energy.kinetic);
    }
}

// The rack's momentum and those of the suspensions that it moves, body by body.
TEST_P(FreeRack, HasTheMomentaOfItsBodies) {
    Simulation simulation(car(), test::steering_moves(car(), 1));
    test::run_to_end(simulation);
    const Sample s = simulation.sample();
    const Vehicle<double>& vehicle = s.model.vehicle;
    double rack = vehicle.steering.rack_mass * s.velocity.rack.rate, size = std::abs(rack);
    for (std::size_t k = 0; k < vehicle.suspensions.size(); ++k) {
        const Suspension<double>& suspension = vehicle.suspensions[k];
        const SuspensionVelocity<double>& at = s.velocity.suspensions[k];
        std::array<double, max_freedoms> P{};
        const auto add = [&](int frame, const Spatial<double>& h) {
            const auto f = static_cast<std::size_t>(frame);
            for (int j = 0; j < suspension.linkage.nV(); ++j) {
                P[static_cast<std::size_t>(j)] += at.at.motion.J[f].col(j).dot(h);
            }
            if (suspension.unit != 0) return;
            rack += at.at.motion.x[f].dot(h), size += std::abs(at.at.motion.x[f].dot(h));
        };
        for (std::size_t i = 0; i < suspension.bodies.size(); ++i) {
            const int frame = suspension.bodies[i].frame;
            add(frame, at.inertia[i] * at.motion[static_cast<std::size_t>(frame)]);
        }
        for (std::size_t i = 0; i < suspension.wheels.size(); ++i) {
            add(suspension.wheels[i].frame, spatial<double>(Vec3<double>::Zero(), at.spin_momentum[i]));
        }
        for (int j = 0; j < suspension.linkage.nV(); ++j) {
            const double own = P[static_cast<std::size_t>(j)];
            EXPECT_NEAR(own, suspension.state(s.state.values.data()).momentum[j], 1e-9 * (1 + std::abs(own)));
        }
    }
    EXPECT_NEAR(rack, test::steering_state(s.model, s.state).rack_momentum, 1e-11 * size);
    EXPECT_GT(size, 1);
}

// Frames move by the rack as their poses say: by differences of the poses over the rack's displacement.
TEST_P(FreeRack, MovesItsFramesAtItsOwnRate) {
    Simulation simulation(car(), test::steering_moves(car(), 0.6));
    test::run_to_end(simulation);
    const Model<double>& model = simulation.model();
    const Instant at{model, simulation.state(), simulation.schedule()(simulation.time())};
    const State<double> rate = at.rate();
    ASSERT_GT(std::abs(at.velocity.rack.rate), 1e-3);
    for (std::size_t s = 0; s < model.vehicle.suspensions.size(); ++s) {
        const int frame = model.vehicle.suspensions[s].wheels[0].frame;
        const auto center = [&](double time) {
            const State<double> then = state_after(model, at.state, rate, time);
            return Vec3<double>(velocity_block(model, then, at.input).suspensions[s].center[0]);
        };
        const Spatial<double> against_unit =
            at.velocity.suspensions[s].motion[static_cast<std::size_t>(frame)] - at.velocity.suspensions[s].motion[0];
        const Vec3<double> moved = velocity_at<double>(against_unit, at.velocity.suspensions[s].center[0]);
        EXPECT_LT((test::derivative(center, 0, 1e-4) - moved).norm(), 1e-8) << s;
    }
}

}  // namespace
}  // namespace hamilcar
