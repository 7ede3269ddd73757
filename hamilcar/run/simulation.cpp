#include "hamilcar/run/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "hamilcar/analysis/loops.hpp"
#include "hamilcar/engine/library.hpp"
#include "hamilcar/integrator/stabilization.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/math/convert.hpp"

namespace hamilcar {

namespace {

// A mistake at a key of the scenario; the message goes on after the key's name.
[[noreturn]] void reject(const std::string& key, const std::string& message) {
    throw io::Error(io::ExitCode::bad_file, fmt::format("key '{}'{}", key, message), key);
}

const Method& require_method(const SolverDescription& solver) {
    const Method* method = find_method(solver.integrator);
    if (method) return *method;
    std::string known;
    for (const Method& m : methods) known += (known.empty() ? "" : ", ") + std::string(m.name);
    reject("solver.integrator", fmt::format(" = \"{}\": expected one of {}", solver.integrator, known));
}

double require_gain(const SolverDescription& solver) {
    require_method(solver);
    const GainChoice choice = stabilization_gain(solver);
    if (choice.expectation.empty()) return choice.gain;
    reject("solver.stabilization_gain_per_s", fmt::format(" = {:g}: expected {}", choice.gain, choice.expectation));
}

Model<double> make_model(const VehicleDescription& vehicle, const ScenarioDescription& scenario,
                         const Surface* surface) {
    return {.vehicle = Vehicle<double>(vehicle),
            .road = PlaneRoad<double>(scenario.road.grade, scenario.road.bank, scenario.road.friction),
            .surface = SurfaceOfLanes<double>(surface),
            .chart = scenario.solver.chart,
            .constraints = scenario.solver.constraints,
            .stabilization_gain = require_gain(scenario.solver),
            .energy_balance = scenario.solver.energy_balance};
}

// An input that nothing in the car listens to is a mistake in the scenario or in the vehicle.
void check_inputs(const ScenarioDescription& scenario, const VehicleDescription& vehicle) {
    if (scenario.steering_input == SteeringInput::steering_wheel && vehicle.steering.rack_per_revolution <= 0) {
        reject("inputs.steering_wheel",
               fmt::format(": {} has no [steering]; expected rack_m_per_revolution there, or inputs.rack here",
                           vehicle.name));
    }
    const double driven = driven_share(vehicle);
    for (const double torque : scenario.drive.value) {
        if (torque == 0 || driven > 0) continue;
        reject("inputs.drive",
               fmt::format(" asks for {:g} N m, but no axle of {} is driven; expected a drive_share there", torque,
                           vehicle.name));
    }
}

// A post that stands under no wheel is a mistake in the scenario.
void check_posts(const ScenarioDescription& scenario, const VehicleDescription& vehicle) {
    std::size_t wheels = 0;
    for_each_wheel(vehicle, [&](const auto&, std::size_t) { ++wheels; });
    const std::size_t posts = scenario.road.posts.height.size();
    if (posts <= wheels) return;
    reject("road.posts.wheel", fmt::format(": {} posts for the {} wheels of {}", posts, wheels, vehicle.name));
}

// The rack ends at its stops; a schedule that asks for more is a mistake, not a wish.
void check_rack(const ScenarioDescription& scenario, const SteeringDescription& steering) {
    if (scenario.steering_input == SteeringInput::none || steering.rack_travel <= 0) return;
    const bool wheel = scenario.steering_input == SteeringInput::steering_wheel;
    const double scale = wheel ? steering.rack_per_revolution / (2 * std::numbers::pi) : 1.0;
    for (std::size_t i = 0; i < scenario.steering.value.size(); ++i) {
        const double rack = scale * scenario.steering.value[i];
        if (std::abs(rack) <= steering.rack_travel) continue;
        reject(wheel ? "inputs.steering_wheel" : "inputs.rack",
               fmt::format(" at t = {:g} s: the rack would stand at {:.4g}, expected within -{} to {} [m]",
                           scenario.steering.time[i], rack, steering.rack_travel, steering.rack_travel));
    }
}

// Chassis axes along the ground: z the normal, x the heading laid into the plane.
Mat3<double> heading_on(const Vec3<double>& normal, double yaw) {
    const Vec3<double> ahead(std::cos(yaw), std::sin(yaw), 0);
    Mat3<double> R;
    R.col(2) = normal;
    R.col(1) = normal.cross(ahead).normalized();
    R.col(0) = R.col(1).cross(R.col(2));
    return R;
}

// Where a vehicle starts: the plane through the ground under its wheels, by least squares.
struct StartingGround {
    Vec3<double> normal;
    double height;  // at the vehicle's origin [m]
};

StartingGround starting_ground(const Model<double>& model, const VehicleDescription& vehicle,
                               const InitialDescription& initial) {
    const Vec3<double>& n = model.road.normal;
    const double x = initial.position[0], y = initial.position[1], c = std::cos(initial.yaw), s = std::sin(initial.yaw);
    const double foot = -(n[0] * x + n[1] * y) / n[2];
    const Surface* surface = model.surface.lanes[0];
    if (!surface) return {n, foot};
    Mat3<double> A = Mat3<double>::Zero();
    Vec3<double> b = Vec3<double>::Zero();
    int number = 0;
    for_each_wheel(vehicle, [&](const auto& wheel, std::size_t) {
        const Point& center = wheel.wheel.center;
        const double dx = c * center[0] - s * center[1], dy = s * center[0] + c * center[1];
        const Vec3<double> row(1, dx, dy);
        A += row * row.transpose();
        b +=
            row * (surface->height(x + dx, y + dy) - (n[0] * dx + n[1] * dy) / n[2] + surface->post(number++, 0).value);
    });
    const Vec3<double> plane = A.inverse() * b;                        // height above the foot: p0 + p1 dx + p2 dy
    if (!plane.allFinite()) return {n, foot + surface->height(x, y)};  // wheels in one line
    return {Vec3<double>(-plane[1], -plane[2], 1).normalized(), foot + plane[0]};
}

}  // namespace

Simulation::Simulation(VehicleDescription vehicle, ScenarioDescription scenario)
    : vehicle_(std::move(vehicle)),
      scenario_(std::move(scenario)),
      surface_(make_surface(scenario_.road)),
      model_(make_model(vehicle_, scenario_, surface_.get())),
      engine_(&best_engine()),
      schedule_(scenario_, vehicle_.steering),
      integrator_(require_method(scenario_.solver), scenario_.solver.step, model_.vehicle.state_size,
                  scenario_.solver.tolerance),
      total_steps_(std::lround(scenario_.duration / scenario_.solver.step)) {
    check_inputs(scenario_, vehicle_);
    check_posts(scenario_, vehicle_);
    check_rack(scenario_, vehicle_.steering);
    start();
}

void Simulation::start() {
    const InitialDescription& initial = scenario_.initial;
    const Input<double> input = schedule_(0);
    const StartingGround ground = starting_ground(model_, vehicle_, initial);
    const Vec3<double>& n = ground.normal;
    const Mat3<double> heading = heading_on(n, initial.yaw);
    const Vec3<double> foot(initial.position[0], initial.position[1], ground.height);
    const Mat3<double> R = initial.settle
                               ? heading
                               : Mat3<double>(heading * axis_rotation<double>(Vec3<double>::UnitY(), initial.pitch) *
                                              axis_rotation<double>(Vec3<double>::UnitX(), initial.roll));
    state_ = design_state(model_, foot + n * (initial.settle ? 0 : initial.height), R);
    RackMotion<double> rack;  // closed at the straight-ahead position first, then led to the rack's start
    AssemblyResult assembly = assemble(model_, rack, state_);
    constexpr int lead_in = 10;
    for (int i = 1; i <= lead_in && assembly.assembled && input.rack.displacement != 0; ++i) {
        rack.displacement = input.rack.displacement * i / lead_in;
        assembly = assemble(model_, rack, state_);
    }
    if (!assembly.assembled)
        throw io::Error(io::ExitCode::numerical, assembly_problem(vehicle_, model_, assembly.worst));
    if (initial.settle) {
        const EquilibriumResult result = settle(model_, input, state_);
        if (!result.found) {
            throw io::Error(io::ExitCode::numerical,
                            fmt::format("the car does not settle on the road: {:.3g} N or N m stay unbalanced; check "
                                        "springs, tires and masses, or set initial.settle = false",
                                        result.residual));
        }
    }
    set_velocities(model_, input, spatial<double>(vec3(initial.velocity), vec3(initial.angular_velocity)), state_);
    last_good_ = state_;
    const std::string problem = inspect(velocity_block(model_, state_, input).health);
    if (!problem.empty()) throw io::Error(io::ExitCode::numerical, "at the start: " + problem);
    initial_balance_ = sample().energy.balance();
}

std::optional<End> Simulation::advance() {
    copy_state(state_, model_.vehicle.state_size, last_good_);
    const Health<double> health = engine_->advance_car(model_, integrator_, schedule_, time(), state_);
    const std::string problem = inspect(health);
    if (problem.empty()) {
        ++step_count_;
        return std::nullopt;
    }
    copy_state(last_good_, model_.vehicle.state_size, state_);
    return End{time(), fmt::format("at t = {:.6g} s: {}; the results end at t = {:.6g} s", time() + integrator_.step(),
                                   problem, time())};
}

void Simulation::save(Snapshot& to) const {
    to.step_count = step_count_;
    copy_state(state_, model_.vehicle.state_size, to.state);
    integrator_.save(to.memory);
}

void Simulation::restore(const Snapshot& from) {
    step_count_ = from.step_count;
    copy_state(from.state, model_.vehicle.state_size, state_);
    integrator_.restore(from.memory);
}

// What is wrong after a step, or nothing: all numbers finite, loops closed, linkages free.
std::string Simulation::inspect(const Health<double>& health) const {
    double sum = 0;
    for (int i = 0; i < model_.vehicle.state_size; ++i) sum += 0 * state_.values[i];
    if (sum != 0) return "the state is no longer finite; try a smaller step or a smaller stabilization gain";
    if (!integrator_.converged()) {
        return fmt::format("{} cannot meet the tolerance {:g} with any step", integrator_.method().name,
                           scenario_.solver.tolerance);
    }
    const bool locks = health.locks();
    if (!locks && !health.comes_apart()) return {};
    const RackMotion<double> rack = schedule_(time()).rack;
    LoopReport worst = inspect_loops(model_, rack, state_, 0);
    for (int i = 1; i < loop_count(model_.vehicle); ++i) {
        const LoopReport loop = inspect_loops(model_, rack, state_, i);
        if (locks ? loop.mobility < worst.mobility : loop.opening > worst.opening) worst = loop;
    }
    if (locks) {
        return fmt::format("the linkage of {} locks at '{}'{}: it cannot move further this way",
                           spoke_name(vehicle_, worst.spoke), cut_name(vehicle_, model_, worst.spoke, worst.locking),
                           travels(worst.spoke));
    }
    return fmt::format(
        "{} came apart: '{}' stands open by {:.1f} mm{}; the linkage may be past its reach, or try a smaller "
        "step",
        spoke_name(vehicle_, worst.spoke), cut_name(vehicle_, model_, worst.spoke, worst.cut), 1e3 * worst.opening,
        travels(worst.spoke));
}

// ", wheel travel +85 mm (rear_left)" of the last good state, or of the wheels of both sides.
std::string Simulation::travels(int spoke) const {
    const Velocity<double> velocity = velocity_block(model_, last_good_, schedule_(time()));
    const int corners = model_.vehicle.spoke_count();
    if (spoke < corners) {
        const double travel =
            visit_spoke(model_.vehicle, velocity, spoke,
                        [](const auto& own, const auto&, const auto& at) { return wheel_travel(own, at); });
        return fmt::format(", wheel travel {:+.0f} mm ({})", 1e3 * travel, spoke_name(vehicle_, spoke));
    }
    const auto i = static_cast<std::size_t>(spoke - corners);
    const ComposedSpoke<double>& composed = model_.vehicle.composed[i];
    std::string text;
    for (std::size_t w = 0; w < composed.wheels.size(); ++w) {
        const double travel = velocity.composed.spokes[i].center[w][2] - composed.wheels[w].wheel.center[2];
        text += fmt::format(", wheel travel {:+.0f} mm ({})", 1e3 * travel, vehicle_.composed[i].wheels[w].name);
    }
    return text;
}

Sample Simulation::sample() const {
    const Input<double> input = schedule_(time());
    Sample s{.time = time(),
             .model = model_,
             .state = state_,
             .input = input,
             .velocity = velocity_block(model_, state_, input),
             .momenta = {},
             .energy = {},
             .violation = 0,
             .constraint_norm = 0,
             .mobility = 1};
    s.momenta = momenta_block(model_, state_, input, s.velocity);
    s.energy = energy(model_, state_, s.velocity, s.momenta);
    if (!model_.energy_balance) s.energy.work = std::numeric_limits<double>::quiet_NaN();  // nobody kept it
    for (int i = 0; i < loop_count(model_.vehicle); ++i) {
        const LoopReport loop = inspect_loops(model_, input.rack, state_, i);
        s.violation = std::max(s.violation, loop.opening);
        s.mobility = std::min(s.mobility, loop.mobility);
    }
    for (int i = 0; i < model_.vehicle.spoke_count(); ++i) {
        visit_spoke(model_.vehicle, s.velocity, i, [&](const auto&, const auto&, const auto& at) {
            if constexpr (std::decay_t<decltype(at.position.Phi)>::SizeAtCompileTime > 0) {
                s.constraint_norm += at.position.Phi.squaredNorm();
            }
        });
    }
    for (std::size_t i = 0; i < model_.vehicle.composed.size(); ++i) {
        for (int e = 0; e < model_.vehicle.composed[i].linkage.nW(); ++e) {
            const double Phi = s.velocity.composed.spokes[i].at.Phi[static_cast<std::size_t>(e)];
            s.constraint_norm += Phi * Phi;
        }
    }
    s.constraint_norm = std::sqrt(s.constraint_norm);
    return s;
}

}  // namespace hamilcar
