// The public face of the Simbody car: states in and out, and a Runge-Kutta of our own with projection.

#include "tests/oracle/simbody_car.hpp"

#include "tests/oracle/simbody_parts.hpp"

#include <algorithm>

namespace hamilcar::oracle {

using SimTK::Mat33;
using SimTK::MobilizedBody;
using SimTK::Rotation;
using SimTK::Stage;
using SimTK::State;
using SimTK::Transform;
using SimTK::Vec3;
using SimTK::Vector;

namespace {

constexpr double projection_accuracy = 1e-13;

// Of a step. Where the rack's acceleration jumps between two steps each has its own; a step that took the other's would
// leave its linkage open by the first order of h, and the projection would close it by moving the chassis as well.
constexpr double within = 1e-6;

}  // namespace

struct SimbodyCar::Engine {
    Engine(const VehicleDescription& description, const Road& road, SpindleModel spindle_model);

    // Time and inputs change everything Simbody has computed for the state.
    void impose(double time, const Inputs& inputs) {
        parts.inputs = inputs;
        state.setTime(time);
    }
    void project() { system.project(state, projection_accuracy); }
    void realize_accelerations() {
        system.realize(state, Stage::Time);
        system.prescribe(state);
        system.realize(state, Stage::Acceleration);
    }
    Vector rate(double time, const Inputs& inputs, const Vector& y);

    Parts parts;
    SimTK::MultibodySystem system;
    SimTK::SimbodyMatterSubsystem matter{system};
    SimTK::GeneralForceSubsystem forces{system};
    SimTK::Force::Gravity gravity;
    State state;
};

SimbodyCar::Engine::Engine(const VehicleDescription& description, const Road& road, SpindleModel spindle_model)
    : parts{description, road, spindle_model}, gravity(forces, matter, -SimTK::ZAxis, description.gravity) {
    add_bodies(parts, matter.Ground());
    SimTK::Force::Custom(forces, make_forces(parts, forces));
    state = system.realizeTopology();
    system.realizeModel(state);
}

Vector SimbodyCar::Engine::rate(double time, const Inputs& inputs, const Vector& y) {
    impose(time, inputs);
    state.updY() = y;
    realize_accelerations();
    return state.getYDot();
}

SimbodyCar::SimbodyCar(const VehicleDescription& description, const Road& road, SpindleModel spindle_model)
    : engine_(std::make_unique<Engine>(description, road, spindle_model)) {
    set_state(state());  // everything is at design yet
}

SimbodyCar::~SimbodyCar() = default;

void SimbodyCar::set_inputs(const Inputs& inputs) {
    engine_->impose(engine_->state.getTime(), inputs);
}

void SimbodyCar::set_state(const CarState& values) {
    Engine& engine = *engine_;
    const auto& r = values.rotation;
    const Rotation rotation(Mat33(r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8]));
    MobilizedBody& chassis = engine.parts.chassis;
    chassis.setQToFitTransform(engine.state, Transform(rotation, to_vec3(values.position)));
    chassis.setUToFitVelocity(engine.state, {to_vec3(values.angular_velocity), to_vec3(values.velocity)});
    const Parts& parts = engine.parts;
    Vector& z = engine.forces.updZ(engine.state);
    for (std::size_t i = 0; i < parts.suspensions.size(); ++i)
        set_suspension(parts, i, values.suspensions.at(i), engine.state, z);
    for (std::size_t i = 0; i < parts.hitches.size(); ++i) set_hitch(parts, i, values.trailers.at(i), engine.state);
    engine.project();
}

CarState SimbodyCar::state() const {
    const Engine& engine = *engine_;
    const MobilizedBody& chassis = engine.parts.chassis;
    engine.system.realize(engine.state, Stage::Velocity);
    CarState values;
    const Vec3 velocity = chassis.getBodyOriginVelocity(engine.state);
    const Vec3 angular_velocity = chassis.getBodyAngularVelocity(engine.state);
    const Rotation& rotation = chassis.getBodyRotation(engine.state);
    for (int i = 0; i < 3; ++i) {
        values.position[i] = chassis.getBodyOriginLocation(engine.state)[i];
        values.velocity[i] = velocity[i];
        values.angular_velocity[i] = angular_velocity[i];
        for (int j = 0; j < 3; ++j) values.rotation[3 * i + j] = rotation[i][j];
    }
    const Vector& z = engine.forces.getZ(engine.state);
    for (std::size_t i = 0; i < engine.parts.suspensions.size(); ++i)
        values.suspensions.push_back(suspension_of(engine.parts, i, engine.state, z));
    for (std::size_t i = 0; i < engine.parts.hitches.size(); ++i)
        values.trailers.push_back(hitch_of(engine.parts, i, engine.state));
    return values;
}

std::array<double, 3> SimbodyCar::ground_point(std::size_t unit, const Point& point) const {
    const Placed& body = engine_->parts.bodies.at(unit);
    engine_->system.realize(engine_->state, Stage::Position);
    const Vec3 at = body.body.findStationLocationInGround(engine_->state, body.station(point));
    return {at[0], at[1], at[2]};
}

double SimbodyCar::energy() const {
    engine_->system.realize(engine_->state, Stage::Dynamics);
    return engine_->system.calcEnergy(engine_->state);
}

// Each step takes the rack's acceleration at its ends from within.
void SimbodyCar::advance(double t0, double h, int steps, const std::function<Inputs(double)>& inputs) {
    Engine& engine = *engine_;
    engine.impose(t0, inputs(t0));
    engine.project();
    for (int n = 0; n < steps; ++n) {
        const double t = t0 + n * h, end_time = t0 + (n + 1) * h;
        Inputs start = inputs(t), end = inputs(end_time);
        const Inputs middle = inputs(t + h / 2);
        start.rack_acceleration = inputs(t + within * h).rack_acceleration;
        end.rack_acceleration = inputs(end_time - within * h).rack_acceleration;
        const Vector y = engine.state.getY();
        const Vector k1 = engine.rate(t, start, y);
        const Vector k2 = engine.rate(t + h / 2, middle, y + h / 2 * k1);
        const Vector k3 = engine.rate(t + h / 2, middle, y + h / 2 * k2);
        const Vector k4 = engine.rate(end_time, end, y + h * k3);
        engine.impose(end_time, end);
        engine.state.updY() = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        engine.project();
    }
}

double SimbodyCar::evaluate_accelerations_once(const Inputs& inputs) {
    Engine& engine = *engine_;
    engine.impose(engine.state.getTime(), inputs);
    engine.state.updY();  // else Simbody keeps kinematics and articulated inertias of the evaluation before
    engine.realize_accelerations();
    return engine.state.getUDot().norm();
}

double SimbodyCar::worst_constraint_error() const {
    engine_->system.realize(engine_->state, Stage::Velocity);
    return std::max(engine_->state.getQErr().normInf(), engine_->state.getUErr().normInf());
}

}  // namespace hamilcar::oracle
