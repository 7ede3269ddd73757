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

}  // namespace

struct SimbodyCar::Engine {
    Engine(const VehicleDescription& description, const Road& road, SpindleModel spindle_model);

    void set_spindle(std::size_t i, const Corner& corner);
    void set_corner(std::size_t i, const Corner& corner);
    Corner corner(std::size_t i) const;

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
    : parts{description, road, spindle_model, {}, {}, {}}, gravity(forces, matter, -SimTK::ZAxis, description.gravity) {
    add_bodies(parts, matter.Ground());
    SimTK::Force::Custom(forces, make_forces(parts, forces));
    state = system.realizeTopology();
    system.realizeModel(state);
}

void SimbodyCar::Engine::set_spindle(std::size_t i, const Corner& values) {
    const CornerParts& bodies = parts.corners[i];
    const Linkage linkage(parts.description.corners[i]);
    const Transform pose = spindle_pose(linkage, values.independent, parts.inputs.rack);
    const SimTK::SpatialVec twist = spindle_twist(linkage, pose, values.independent_rate, parts.inputs);
    if (parts.spindle_model == SpindleModel::free) {
        bodies.carrier.setQToFitTransform(state, Transform(pose.R(), pose.p() - linkage.wheel_center));
        bodies.carrier.setUToFitVelocity(state, twist);
    } else {  // the piston rod turns with the spindle
        bodies.piston_rod.setQToFitRotation(state, pose.R());
        bodies.piston_rod.setUToFitAngularVelocity(state, twist[0]);
        bodies.carrier.setOneQ(state, 0, values.independent);
        bodies.carrier.setOneU(state, 0, values.independent_rate);
    }
}

void SimbodyCar::Engine::set_corner(std::size_t i, const Corner& values) {
    const CornerDescription& corner = parts.description.corners[i];
    const CornerParts& bodies = parts.corners[i];
    if (std::holds_alternative<MacPhersonDescription>(corner.suspension)) {
        set_spindle(i, values);
    } else {
        bodies.carrier.setOneQ(state, 0, values.independent);
        bodies.carrier.setOneU(state, 0, values.independent_rate);
    }
    bodies.wheel.setOneQ(state, 0, 0);  // a body of revolution: its angle means nothing
    bodies.wheel.setOneU(state, 0, values.spin);
    const int z = 3 * static_cast<int>(i);
    Vector& deflection = forces.updZ(state);
    deflection[z] = values.u;
    deflection[z + 1] = values.v;
    deflection[z + 2] = values.b;
}

Corner SimbodyCar::Engine::corner(std::size_t i) const {
    const CornerDescription& description = parts.description.corners[i];
    const CornerParts& bodies = parts.corners[i];
    Corner values;
    if (const auto* strut = std::get_if<MacPhersonDescription>(&description.suspension)) {
        const Line line = line_between(parts, CarMotion(parts, state), i, strut->slide_point, strut->strut_top);
        values.independent = line.length;
        values.independent_rate = line.rate;
    } else {
        values.independent = bodies.carrier.getOneQ(state, 0);
        values.independent_rate = bodies.carrier.getOneU(state, 0);
    }
    values.spin = bodies.wheel.getOneU(state, 0);
    const int z = 3 * static_cast<int>(i);
    const Vector& deflection = forces.getZ(state);
    values.u = deflection[z];
    values.v = deflection[z + 1];
    values.b = deflection[z + 2];
    return values;
}

Vector SimbodyCar::Engine::rate(double time, const Inputs& inputs, const Vector& y) {
    impose(time, inputs);
    state.updY() = y;
    realize_accelerations();
    return state.getYDot();
}

SimbodyCar::SimbodyCar(const VehicleDescription& description, const Road& road, SpindleModel spindle_model)
    : engine_(std::make_unique<Engine>(description, road, spindle_model)) {
    CarState design;
    for (const CornerDescription& corner : description.corners) {
        design.corners.emplace_back();
        if (const auto* strut = std::get_if<MacPhersonDescription>(&corner.suspension))
            design.corners.back().independent = (to_vec3(strut->strut_top) - to_vec3(strut->slide_point)).norm();
    }
    set_state(design);
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
    for (std::size_t i = 0; i < engine.parts.corners.size(); ++i) engine.set_corner(i, values.corners.at(i));
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
    for (std::size_t i = 0; i < engine.parts.corners.size(); ++i) values.corners.push_back(engine.corner(i));
    return values;
}

double SimbodyCar::energy() const {
    engine_->system.realize(engine_->state, Stage::Dynamics);
    return engine_->system.calcEnergy(engine_->state);
}

void SimbodyCar::advance(double t0, double h, int steps, const std::function<Inputs(double)>& inputs) {
    Engine& engine = *engine_;
    Inputs start = inputs(t0);
    engine.impose(t0, start);
    engine.project();
    for (int n = 0; n < steps; ++n) {
        const double t = t0 + n * h, end_time = t0 + (n + 1) * h;
        const Inputs middle = inputs(t + h / 2), end = inputs(end_time);
        const Vector y = engine.state.getY();
        const Vector k1 = engine.rate(t, start, y);
        const Vector k2 = engine.rate(t + h / 2, middle, y + h / 2 * k1);
        const Vector k3 = engine.rate(t + h / 2, middle, y + h / 2 * k2);
        const Vector k4 = engine.rate(end_time, end, y + h * k3);
        engine.impose(end_time, end);
        engine.state.updY() = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        engine.project();
        start = end;
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
