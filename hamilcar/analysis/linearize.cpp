// Derivatives of the reduced equations by dual numbers, some columns a pass. Apart from everything in doubles, since it is
// compiled for size: the whole program once more, on a number of nine.
#include <Eigen/Core>

#include "hamilcar/analysis/dimensions.hpp"
#include "hamilcar/analysis/linear_model.hpp"
#include "hamilcar/math/convert.hpp"
#include "hamilcar/math/dual.hpp"

namespace hamilcar {

namespace {

constexpr int partials = 8;  // columns a pass
using D = Dual<double, partials>;

template <class T>
std::vector<T> listed(const ReducedOutputs<T>& out, const T& roll, const T& pitch) {
    std::vector<T> y{
        out.speed, out.lateral_velocity, out.yaw_rate, out.lateral_acceleration, out.vertical_velocity, roll, pitch};
    y.insert(y.end(), out.wheel_travel.begin(), out.wheel_travel.end());
    y.insert(y.end(), out.tire_load.begin(), out.tire_load.end());
    return y;
}

void name_outputs(const VehicleDescription& d, LinearModel& model) {
    model.outputs = {
        "chassis.speed",          "chassis.lateral_velocity", "chassis.rate.yaw",   "chassis.lateral_acceleration",
        "seat.vertical_velocity", "chassis.angle.roll",       "chassis.angle.pitch"};
    model.output_units = {"m/s", "m/s", "rad/s", "m/s^2", "m/s", "rad", "rad"};
    for (const std::string& name : wheel_names(d)) model.outputs.push_back(name + ".wheel.travel");
    for (const std::string& name : wheel_names(d)) model.outputs.push_back(name + ".tire.vertical_force");
    model.output_units.resize(first_wheel_output + wheel_names(d).size(), "m");
    model.output_units.resize(model.outputs.size(), "N");
}

}  // namespace

LinearModel Linearizer::linearize(const OperatingPoint& at) const {
    Model<D> model{.vehicle = Vehicle<D>(vehicle_), .road = PlaneRoad<D>(D(0), D(0), D(1))};
    const int n = reduced_.size(), columns = n + linear_input_count;
    LinearModel out;
    out.A.resize(n, n), out.B.resize(n, linear_input_count);
    out.rate.resize(n);
    std::vector<D> z(static_cast<std::size_t>(n)), rate(static_cast<std::size_t>(n));
    const Vec3<D> seat = as<D>(vec3(seat_));
    for (int first = 0; first < columns; first += partials) {
        const auto seeded = [&](double value, int column) {
            const bool mine = column >= first && column < first + partials;
            return mine ? D::variable(value, column - first) : D(value);
        };
        for (int i = 0; i < n; ++i) z[static_cast<std::size_t>(i)] = seeded(at.z[i], i);
        Input<D> input;
        input.rack.displacement = seeded(at.input.rack.displacement, n + rack);
        input.rack.rate = seeded(at.input.rack.rate, n + rack_rate);
        input.drive_torque = seeded(at.input.drive_torque, n + drive_torque);
        input.brake = seeded(at.input.brake, n + brake);
        model.vehicle.gravity = seeded(vehicle_.gravity, n + gravity);
        const std::vector<D> y =
            listed(reduced_rates(model, reduced_, input, z.data(), at.state, seat, rate.data()), z[1], z[2]);
        const auto outputs = static_cast<Eigen::Index>(y.size());
        if (first == 0) out.C.resize(outputs, n), out.D.resize(outputs, linear_input_count), out.output.resize(outputs);
        for (int k = 0; k < partials && first + k < columns; ++k) {
            const int column = first + k;
            for (int i = 0; i < n; ++i) {
                (column < n ? out.A(i, column) : out.B(i, column - n)) = rate[static_cast<std::size_t>(i)].partial(k);
            }
            for (Eigen::Index i = 0; i < outputs; ++i) {
                (column < n ? out.C(i, column) : out.D(i, column - n)) = y[static_cast<std::size_t>(i)].partial(k);
            }
        }
        for (int i = 0; i < n; ++i) out.rate[i] = rate[static_cast<std::size_t>(i)].value();
        for (Eigen::Index i = 0; i < outputs; ++i) out.output[i] = y[static_cast<std::size_t>(i)].value();
    }
    for (const StateNumber& number : reduced_.numbers()) {
        out.states.push_back(number.name), out.state_kinds.push_back(number.kind);
    }
    out.inputs = {"rack [m]", "rack rate [m/s]", "drive torque [N m]", "brake [1]", "gravity [m/s^2]"};
    name_outputs(vehicle_, out);
    return out;
}

}  // namespace hamilcar
