#include "hamilcar/run/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hamilcar/analysis/loops.hpp"
#include "hamilcar/engine/car_rhs.hpp"
#include "hamilcar/integrator/stabilization.hpp"
#include "hamilcar/io/error.hpp"
#include "hamilcar/math/convert.hpp"
#include "hamilcar/run/controlled_car.hpp"
#include "hamilcar/run/driven_car.hpp"
#include "hamilcar/run/scenario_checks.hpp"
#include "hamilcar/run/starting_ground.hpp"

namespace hamilcar {

namespace {

const Method& require_method(const ScenarioDescription& scenario) {
    const SolverDescription& solver = scenario.solver;
    const Method* method = find_method(solver.integrator);
    if (method) return *method;
    std::string known;
    for (const Method& m : methods) known += (known.empty() ? "" : ", ") + std::string(m.name);
    reject_key(scenario, "solver.integrator", fmt::format(" = \"{}\": expected one of {}", solver.integrator, known));
}

double require_gain(const ScenarioDescription& scenario) {
    const SolverDescription& solver = scenario.solver;
    require_method(scenario);
    const GainChoice choice = stabilization_gain(solver);
    if (choice.expectation.empty()) return choice.gain;
    reject_key(scenario, "solver.stabilization_gain_per_s",
               fmt::format(" = {:g}: expected {}", choice.gain, choice.expectation));
}

// A car that cannot stand or move.
[[noreturn]] void refuse_vehicle(const VehicleDescription& vehicle, const std::string& problem) {
    throw io::Error(io::ExitCode::numerical, at_key(vehicle.places) + problem);
}

Model<double> make_model(const VehicleDescription& vehicle, const ScenarioDescription& scenario,
                         const Surface* surface) {
    return {.vehicle = Vehicle<double>(vehicle),
            .road = PlaneRoad<double>(scenario.road.grade, scenario.road.bank, scenario.road.friction),
            .surface = surface,
            .chart = scenario.solver.chart,
            .constraints = scenario.solver.constraints,
            .stabilization_gain = require_gain(scenario),
            .energy_balance = scenario.solver.energy_balance};
}

}  // namespace

Simulation::Simulation(VehicleDescription vehicle, ScenarioDescription scenario)
    : vehicle_(as_driven(std::move(vehicle), scenario)),
      scenario_(std::move(scenario)),
      surface_(make_surface(scenario_.road)),
      model_(make_model(vehicle_, scenario_, surface_.get())),
      schedule_(scenario_, vehicle_.steering),
      column_(vehicle_.steering),
      integrator_(require_method(scenario_), scenario_.solver.step, model_.vehicle.state_size,
                  scenario_.solver.tolerance),
      total_steps_(std::lround(scenario_.duration / scenario_.solver.step)) {
    schedule_.set_commands(CommandLayout(vehicle_).rest());
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
    hold_inputs(model_, input, state_);
    RackMotion<double> rack;  // closed at the straight-ahead position first, then led to the rack's start
    AssemblyResult assembly = assemble(model_, rack, state_);
    constexpr int lead_in = 10;
    for (int i = 1; i <= lead_in && assembly.assembled && input.rack.displacement != 0; ++i) {
        rack.displacement = input.rack.displacement * i / lead_in;
        assembly = assemble(model_, rack, state_);
    }
    if (!assembly.assembled) refuse_vehicle(vehicle_, assembly_problem(vehicle_, model_, assembly.worst));
    if (initial.settle) {
        const EquilibriumResult result = settle(model_, input, state_);
        if (!result.found) {
            refuse_vehicle(vehicle_,
                           fmt::format("the car does not settle on the road: {:.3g} N or N m stay unbalanced; check "
                                       "springs, tires and masses, or set initial.settle = false",
                                       result.residual));
        }
    }
    set_velocities(model_, input, spatial<double>(vec3(initial.velocity), vec3(initial.angular_velocity)), state_);
    set_rotors(model_, input, state_);
    start_driver();
    start_control();
    last_good_ = state_;
    const std::string problem = inspect(velocity_block(model_, state_, input).health);
    if (!problem.empty()) refuse_vehicle(vehicle_, "at the start: " + problem);
    initial_balance_ = sample().energy.balance();
}

// His first decision comes before the run: the gear that is in is the one that the engine turns with.
void Simulation::start_driver() {
    car_ = hamilcar::driven_car(vehicle_, model_, state_);
    DriverDescription described = scenario_.driver;
    steps_per_decision_ = std::max(1L, std::lround(described.interval / integrator_.step()));
    described.interval = static_cast<double>(steps_per_decision_) * integrator_.step();
    try {
        driver_.emplace(described, car_, column_);
    } catch (const std::invalid_argument& mistake) {
        reject_key(scenario_, "driver", fmt::format(": {}", mistake.what()));
    }
    if (!driver_->is_active()) return driver_.reset();
    driver_->begin(schedule_);
    for (int round = 0; round < 2; ++round) {  // a gear is chosen by speeds that a gear gives
        driver_->act(observation(), schedule_);
        set_rotors(model_, schedule_(0), state_);
        hold_pedal(model_, schedule_(0).brake, state_);
    }
}

// What the sensors read before the first step is known before it.
void Simulation::start_control() {
    if (vehicle_.controllers.empty()) return;
    control_ = make_control(scenario_, vehicle_, controlled_car(vehicle_, model_, car_, state_, schedule_(0)));
    State<double> rate;
    const auto evaluation = evaluate_rhs(model_, schedule_(0), state_, rate);
    control_memory_.assign(control_->memory_size(), 0.0);
    std::copy_n(evaluation.measured.begin(), MeasurementPlaces(model_.vehicle).size, control_memory_.begin());
}

void Simulation::switch_controller(std::size_t controller, bool on) {
    std::array<double, max_commands> numbers;
    const std::span<double> commands(numbers.data(), schedule_.commands().size());
    std::ranges::copy(schedule_.commands(), commands.begin());
    control_->switch_on(controller, on, control_memory_, commands);
    schedule_.set_commands(commands);
}

void Simulation::prepare() {
    if (!program_) program_ = rhs_program(model_, default_engine());
}

std::optional<End> Simulation::advance() {
    if (driver_ && step_count_ > 0 && step_count_ % steps_per_decision_ == 0) {
        driver_->act(observation(), schedule_);
        if (driver_->end_reason()) return std::nullopt;  // the run ends here
    }
    if (control_ && control_->is_due(step_count_)) {
        let_decide(*control_, column_, {step_count_, time(), free_steering_wheel(model_.vehicle, state_)},
                   control_memory_, schedule_);
    }
    copy_state(state_, model_.vehicle.state_size, last_good_);
    prepare();
    const CarRhs rhs(*program_, surface_.get());
    const Health<double> health =
        advance_car(rhs, integrator_, schedule_, time(), state_, control_ ? control_memory_.data() : nullptr);
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
    schedule_.save(to.inputs);
    if (driver_) to.driver = driver_->memory();
    std::ranges::copy(control_memory_, to.control.begin());
}

void Simulation::restore(const Snapshot& from) {
    step_count_ = from.step_count;
    copy_state(from.state, model_.vehicle.state_size, state_);
    integrator_.restore(from.memory);
    schedule_.restore(from.inputs);
    if (driver_) driver_->restore(from.driver);
    std::copy_n(from.control.begin(), control_memory_.size(), control_memory_.begin());
}

// Name of the first number of the state that is not finite.
std::string Simulation::first_not_finite() const {
    const StateLayout layout(vehicle_);
    std::size_t i = 0;
    while (std::isfinite(state_.values[i])) ++i;
    return layout.numbers()[i].name;
}

// What is wrong after a step, or nothing: all numbers finite, loops closed, linkages free.
std::string Simulation::inspect(const Health<double>& health) const {
    double sum = 0;
    for (int i = 0; i < model_.vehicle.state_size; ++i) sum += 0 * state_.values[i];
    if (sum != 0) {
        return fmt::format("{} is no longer finite; try a smaller step or a smaller stabilization gain",
                           first_not_finite());
    }
    if (!integrator_.converged()) {
        return fmt::format("{} cannot meet the tolerance {:g} with any step", integrator_.method().name,
                           scenario_.solver.tolerance);
    }
    const bool locks = health.locks();
    if (!locks && !health.loops_open()) return {};
    const RackMotion<double> rack = rack_of(model_.vehicle, state_, schedule_(time()));
    LoopReport worst = inspect_loops(model_, rack, state_, 0);
    for (int i = 1; i < static_cast<int>(model_.vehicle.suspensions.size()); ++i) {
        const LoopReport loop = inspect_loops(model_, rack, state_, i);
        if (locks ? loop.mobility < worst.mobility : loop.violation > worst.violation) worst = loop;
    }
    if (locks) {
        return fmt::format("the linkage of {} locks at '{}'{}: it cannot move further this way",
                           suspension_name(vehicle_, worst.suspension),
                           cut_name(vehicle_, model_, worst.suspension, worst.nearly_redundant),
                           travels(worst.suspension));
    }
    return fmt::format(
        "{}: constraint violation: '{}' stands open by {:.1f} mm{}; the linkage may be past its reach, or try a "
        "smaller "
        "step",
        suspension_name(vehicle_, worst.suspension), cut_name(vehicle_, model_, worst.suspension, worst.cut),
        1e3 * worst.violation, travels(worst.suspension));
}

// ", wheel travel +85 mm (rear_left)" of the last good state, or of the wheels of both sides.
std::string Simulation::travels(int number) const {
    const Velocity<double> velocity = velocity_block(model_, last_good_, schedule_(time()));
    const auto i = static_cast<std::size_t>(number);
    const Suspension<double>& suspension = model_.vehicle.suspensions[i];
    std::string text;
    for (std::size_t w = 0; w < suspension.wheels.size(); ++w) {
        const double travel = velocity.suspensions[i].center[w][2] - suspension.wheels[w].wheel.center[2];
        text += fmt::format(", wheel travel {:+.0f} mm ({})", 1e3 * travel, vehicle_.suspensions[i].wheels[w].name);
    }
    return text;
}

Sample Simulation::sample() const {
    Sample out = sample_at(model_, state_, schedule_(time()));
    out.control = control_.get(), out.control_memory = control_memory_;
    return out;
}

Sample sample_at(const Model<double>& model, const State<double>& state, const Input<double>& input) {
    Sample s{.time = input.time,
             .model = model,
             .state = state,
             .input = input,
             .velocity = velocity_block(model, state, input),
             .momenta = {},
             .energy = {},
             .violation = 0,
             .constraint_norm = 0,
             .mobility = 1};
    s.momenta = momenta_block(model, state, input, s.velocity);
    s.energy = energy(model, state, s.velocity, s.momenta);
    if (!model.energy_balance) s.energy.work = std::numeric_limits<double>::quiet_NaN();  // no account was kept
    for (int i = 0; i < static_cast<int>(model.vehicle.suspensions.size()); ++i) {
        const LoopReport loop = inspect_loops(model, rack_of(model.vehicle, state, input), state, i);
        s.violation = std::max(s.violation, loop.violation);
        s.mobility = std::min(s.mobility, loop.mobility);
    }
    for (std::size_t i = 0; i < model.vehicle.suspensions.size(); ++i) {
        for (int e = 0; e < model.vehicle.suspensions[i].linkage.nW(); ++e) {
            const double Phi = s.velocity.suspensions[i].at.Phi[static_cast<std::size_t>(e)];
            s.constraint_norm += Phi * Phi;
        }
    }
    s.constraint_norm = std::sqrt(s.constraint_norm);
    return s;
}

}  // namespace hamilcar
