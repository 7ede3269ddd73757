// Operating points of a vehicle on a flat road, and its exact linearization there: z' = A dz + B du, y = C dz + D du, by dual
// numbers through the whole model.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <string>
#include <vector>

#include "hamilcar/analysis/reduced.hpp"

namespace hamilcar {

// What a vehicle is asked to do.
struct Operation {
    double speed = 0;                 // of the center of mass [m/s]; zero: at rest
    double lateral_acceleration = 0;  // speed times yaw rate, to the left [m/s^2]
};

// Standing, driving straight, or going round: z' = 0 under constant inputs.
struct OperatingPoint {
    bool found = false;
    std::string problem;  // why not, for a person
    double residual = 0;  // largest |z'| [N, N m, m/s, ...]
    Operation operation;
    Input<double> input;  // the rack and the drive torque it takes
    State<double> state;
    Eigen::VectorXd z;
};

// Columns of B and D. Gravity stands for the road: a flat road that moves up with an acceleration is felt as that much more
// gravity.
enum LinearInput { rack, rack_rate, drive_torque, brake, gravity, linear_input_count };

// The first rows of C and D, then every wheel's travel, then every wheel's load.
enum LinearOutput {
    output_speed,
    output_lateral_velocity,
    output_yaw_rate,
    output_lateral_acceleration,
    output_seat_velocity,
    output_roll,
    output_pitch,
    first_wheel_output
};

struct LinearModel {
    Eigen::MatrixXd A, B, C, D;
    Eigen::VectorXd rate, output;  // z' and y at the operating point
    std::vector<std::string> states, inputs, outputs, output_units;
    std::vector<StateKind> state_kinds;
};

class Linearizer {
public:
    // The seat is a point of the vehicle frame; the chassis' center of mass if absent. Steady dampers are at rest, where most
    // have a kink between bump and rebound: each counts with the mean of both slopes.
    explicit Linearizer(const VehicleDescription& vehicle, const Point* seat = nullptr);

    // The vehicle settles; a moving one is then brought to its speed and led to the lateral acceleration by Newton's method
    // on all of z, the rack and the drive torque.
    OperatingPoint operating_point(const Operation& operation) const;

    LinearModel linearize(const OperatingPoint& at) const;

    const VehicleDescription& vehicle() const { return vehicle_; }  // with such dampers
    const Model<double>& model() const { return model_; }

private:
    OperatingPoint at_rest() const;
    double improve(OperatingPoint& at) const;

    VehicleDescription vehicle_;
    Point seat_;
    Model<double> model_;
    ReducedCoordinates reduced_;
};

// Response of an output to an input at angular frequencies [rad/s], per unit of the input; `rate_input` is driven by the
// input's rate at the same time, or -1.
std::vector<std::complex<double>> frequency_response(const LinearModel& model, int output, int input, int rate_input,
                                                     const std::vector<double>& frequencies);

}  // namespace hamilcar
