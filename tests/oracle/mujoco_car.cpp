// The public face of the MuJoCo car: states in and out, and what MuJoCo calls back for while it steps.

#include "tests/oracle/mujoco_car.hpp"

#include "tests/oracle/mujoco_parts.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hamilcar::oracle {

namespace {

using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

constexpr int chassis = 1;  // 0 is the world

Eigen::Map<Vector3d> vector_at(double* first) {
    return Eigen::Map<Vector3d>(first);
}

// A ball's quaternion, and its angular velocity in the axes that it has turned, as angles about z, x', y''.
void add_angles(const double* ball, const double* turning, TreeState& to) {
    RowMajor R;
    mju_quat2Mat(R.data(), ball);
    const double x = std::asin(R(2, 1)), y = std::atan2(-R(2, 0), R(2, 2));
    const double z_rate = (std::cos(y) * turning[2] - std::sin(y) * turning[0]) / std::cos(x);
    to.coordinates = {std::atan2(-R(0, 1), R(1, 1)), x, y};
    to.rates = {z_rate, std::cos(y) * turning[0] + std::sin(y) * turning[2], turning[1] - std::sin(x) * z_rate};
}

}  // namespace

struct MujocoCar::Engine {
    Engine(const VehicleDescription& description, const Road& road, const MujocoOptions& options);

    void close_loops(const SuspensionIndices& at);
    void set_suspension(const SuspensionIndices& at, const TreeState& values);
    TreeState suspension(const SuspensionIndices& at) const;
    void impose_rack();
    void step(double time, const std::function<Inputs(double)>& inputs_at);

    Body body(int index) const;
    void load(int index, const Vector3d& origin, const Vector3d& force, const Vector3d& moment);
    void evaluate();
    void note_opening();

    // MuJoCo's callbacks are one for all of its models, and it steps a model once when it loads it.
    static thread_local Engine* stepping;
    static void control(const mjModel*, mjData*) {
        if (stepping) stepping->evaluate();
    }
    static double activation_rate(const mjModel*, const mjData*, int actuator) {
        return stepping ? stepping->rates[static_cast<std::size_t>(actuator)] : 0;
    }

    VehicleDescription description;
    Road road;
    Inputs inputs;
    ModelPointer model;
    std::unique_ptr<mjData, void (*)(mjData*)> data;
    std::vector<SuspensionIndices> suspensions;
    const std::function<Inputs(double)>* inputs_at = nullptr;  // of the step under way
    double step_start = 0;
    CarMotion motion;           // of the evaluation under way
    std::vector<double> rates;  // of the activations, from the last evaluation
    double worst_opening = 0;
};

thread_local MujocoCar::Engine* MujocoCar::Engine::stepping = nullptr;

MujocoCar::Engine::Engine(const VehicleDescription& car, const Road& its_road, const MujocoOptions& options)
    : description(car),
      road(its_road),
      model(load_model(write_model(car, options))),
      data(mj_makeData(model.get()), mj_deleteData),
      rates(3 * car.suspensions.size()) {
    for (const SuspensionDescription& suspension : description.suspensions)
        suspensions.push_back(find_suspension(*model, suspension));
    motion.suspensions.resize(suspensions.size());
    mjcb_control = control;
    mjcb_act_dyn = activation_rate;
    // Otherwise it writes a log into the working directory. `step` looks for what matters.
    mju_user_warning = [](const char*) {};
}

// Newton's method on the ball's rotation, with the chassis at the origin; then the ball's rates.
void MujocoCar::Engine::close_loops(const SuspensionIndices& at) {
    double* const ball = data->qpos + at.ball_q;
    for (int iteration = 0; iteration < 50; ++iteration) {
        mj_kinematics(model.get(), data.get());
        mj_comPos(model.get(), data.get());
        mj_tendon(model.get(), data.get());
        const Eigen::Map<const Eigen::Matrix<double, rods_per_strut, Eigen::Dynamic, Eigen::RowMajor>> gradient(
            data->ten_J + at.first_rod * model->nv, rods_per_strut, model->nv);
        const Matrix3d by_ball = gradient.middleCols<3>(at.ball_v);
        const Vector3d opening =
            Eigen::Map<const Vector3d>(data->ten_length + at.first_rod) - Eigen::Map<const Vector3d>(at.rods.data());
        const Vector3d turn = -by_ball.lu().solve(opening);
        mju_quatIntegrate(ball, turn.data(), 1);
        if (turn.norm() > 1e-13) continue;
        const Vector3d others = gradient.col(at.independent_v) * data->qvel[at.independent_v] +
                                gradient.col(at.rack_v) * data->qvel[at.rack_v];
        vector_at(data->qvel + at.ball_v) = -by_ball.lu().solve(others);
        return;
    }
    throw std::runtime_error("the linkage does not reach this slide and rack displacement");
}

void MujocoCar::Engine::set_suspension(const SuspensionIndices& at, const TreeState& values) {
    const WheelState& wheel = values.wheels.at(0);
    data->qpos[at.independent_q] = values.coordinates.at(at.independent());
    data->qvel[at.independent_v] = values.rates.at(at.independent());
    data->qvel[at.spin_v] = wheel.spin;
    data->act[at.states] = wheel.tires.at(0).u;
    data->act[at.states + 1] = wheel.tires.at(0).v;
    data->act[at.states + 2] = wheel.b;
    if (at.is_strut()) close_loops(at);
}

TreeState MujocoCar::Engine::suspension(const SuspensionIndices& at) const {
    TreeState values;
    if (at.is_strut()) add_angles(data->qpos + at.ball_q, data->qvel + at.ball_v, values);
    values.coordinates.push_back(data->qpos[at.independent_q]);
    values.rates.push_back(data->qvel[at.independent_v]);
    const double* const states = data->act + at.states;
    values.wheels.push_back({data->qvel[at.spin_v], states[2], {{states[0], states[1]}}});
    return values;
}

void MujocoCar::Engine::impose_rack() {
    for (const SuspensionIndices& at : suspensions) {
        if (at.rack_q < 0) continue;
        data->qpos[at.rack_q] = inputs.rack;
        data->qvel[at.rack_v] = inputs.rack_rate;
    }
}

void MujocoCar::Engine::step(double time, const std::function<Inputs(double)>& at_time) {
    inputs_at = &at_time;
    data->time = step_start = time;
    inputs = at_time(time);
    impose_rack();
    stepping = this;
    mj_step(model.get(), data.get());
    stepping = nullptr;
    for (const int warning : {mjWARN_INERTIA, mjWARN_BADQPOS, mjWARN_BADQVEL, mjWARN_BADQACC})
        if (data->warning[warning].number > 0) throw std::runtime_error("MuJoCo lost the motion");
}

Body MujocoCar::Engine::body(int index) const {
    double twist[6];  // rotation, then the origin's velocity
    mj_objectVelocity(model.get(), data.get(), mjOBJ_XBODY, index, twist, 0);
    Body result;
    result.rotation = Eigen::Map<const RowMajor>(data->xmat + 9 * index);
    result.origin = vector_at(data->xpos + 3 * index);
    result.angular_velocity = vector_at(twist);
    result.velocity = vector_at(twist + 3);
    return result;
}

// MuJoCo applies loads at a body's center of mass.
void MujocoCar::Engine::load(int index, const Vector3d& origin, const Vector3d& force, const Vector3d& moment) {
    vector_at(data->xfrc_applied + 6 * index) = force;
    vector_at(data->xfrc_applied + 6 * index + 3) = moment - (vector_at(data->xipos + 3 * index) - origin).cross(force);
}

// MuJoCo calls for this whenever positions and velocities are known and accelerations are wanted.
void MujocoCar::Engine::evaluate() {
    if (data->time == step_start) note_opening();
    inputs = (*inputs_at)(data->time);
    motion.chassis = body(chassis);
    for (std::size_t i = 0; i < suspensions.size(); ++i) {
        const SuspensionIndices& at = suspensions[i];
        const double* const states = data->act + at.states;
        motion.suspensions[i] = {};
        motion.suspensions[i].carrier = body(at.carrier);
        motion.suspensions[i].spin = data->qvel[at.spin_v];
        motion.suspensions[i].states = {states[0], states[1], states[2]};
    }
    add_forces(description, road, inputs, motion);
    load(chassis, motion.chassis.origin, motion.chassis.force, motion.chassis.moment);
    for (std::size_t i = 0; i < suspensions.size(); ++i) {
        const SuspensionIndices& at = suspensions[i];
        const SuspensionMotion& wheel = motion.suspensions[i];
        load(at.carrier, wheel.carrier.origin, wheel.carrier.force, wheel.carrier.moment);
        load(at.wheel, wheel.carrier.origin, wheel.wheel_force, wheel.wheel_moment);
        data->qfrc_applied[at.spin_v] = wheel.spin_torque;
        if (at.rack_v >= 0) data->qfrc_applied[at.rack_v] = rack_armature * inputs.rack_acceleration;
        const auto first = static_cast<std::size_t>(at.states);
        rates[first] = wheel.rates.u;
        rates[first + 1] = wheel.rates.v;
        rates[first + 2] = wheel.rates.b;
    }
}

void MujocoCar::Engine::note_opening() {
    for (int i = 0; i < data->ne; ++i) worst_opening = std::max(worst_opening, std::abs(data->efc_pos[i]));
}

MujocoCar::MujocoCar(const VehicleDescription& description, const Road& road, const MujocoOptions& options)
    : engine_(std::make_unique<Engine>(description, road, options)) {
    set_state(state());  // everything is at design yet
}

MujocoCar::~MujocoCar() = default;

void MujocoCar::set_inputs(const Inputs& inputs) {
    engine_->inputs = inputs;
}

void MujocoCar::set_state(const CarState& values) {
    Engine& engine = *engine_;
    mjData& data = *engine.data;
    mj_resetData(engine.model.get(), &data);
    engine.worst_opening = 0;
    engine.impose_rack();
    for (std::size_t i = 0; i < engine.suspensions.size(); ++i)
        engine.set_suspension(engine.suspensions[i], values.suspensions.at(i));
    std::copy(values.position.begin(), values.position.end(), data.qpos);
    mju_mat2Quat(data.qpos + 3, values.rotation.data());
    std::copy(values.velocity.begin(), values.velocity.end(), data.qvel);
    mju_rotVecMatT(data.qvel + 3, values.angular_velocity.data(), values.rotation.data());  // in vehicle axes there
}

CarState MujocoCar::state() const {
    const mjData& data = *engine_->data;
    CarState values;
    std::copy_n(data.qpos, 3, values.position.begin());
    std::copy_n(data.qvel, 3, values.velocity.begin());
    mju_quat2Mat(values.rotation.data(), data.qpos + 3);
    mju_rotVecMat(values.angular_velocity.data(), data.qvel + 3, values.rotation.data());
    for (const SuspensionIndices& at : engine_->suspensions) values.suspensions.push_back(engine_->suspension(at));
    return values;
}

void MujocoCar::advance(double t0, int steps, const std::function<Inputs(double)>& inputs) {
    Engine& engine = *engine_;
    const double h = engine.model->opt.timestep;
    for (int n = 0; n < steps; ++n) engine.step(t0 + n * h, inputs);
    engine.inputs = inputs(t0 + steps * h);
    engine.impose_rack();
}

double MujocoCar::worst_loop_opening() const {
    return engine_->worst_opening;
}

// An opening left to itself obeys r'' = -damping r' - stiffness r. Semi-implicit Euler is stable on that while
// stiffness h^2 + 2 damping h < 4, and at 1 and 1 it closes the loop in two steps. Runge-Kutta of order four is stable
// up to stiffness h^2 = 8 without damping; at 6 and 2 an opening loses a quarter of itself in a step.
MujocoLoops MujocoLoops::stiffest(MujocoIntegrator integrator, double step) {
    const bool rk4 = integrator == MujocoIntegrator::rk4;
    constexpr double hardest = 0.9999;  // MuJoCo cuts the impedance there
    return {{-(rk4 ? 6 : 1) / (step * step), -(rk4 ? 2 : 1) / step}, {hardest, hardest, 0.001, 0.5, 2}};
}

}  // namespace hamilcar::oracle
