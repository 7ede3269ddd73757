// The same car in a third engine: MuJoCo, with joint coordinates and loops that soft constraints close.
//
// As in the Simbody car, nothing of hamilcar but the plain description is used, and the forces come from the page
// docs/models/forces.md. MuJoCo has the bodies, the joints, gravity, the loops and the integration. Its loops are never
// quite closed: it trades a loop's opening against stiffness, and the stiffness against the step.
#pragma once

#include "hamilcar/description/vehicle.hpp"
#include "tests/oracle/simbody_car.hpp"

#include <array>
#include <functional>
#include <memory>

namespace hamilcar::oracle {

// MuJoCo's names. `euler` moves the coordinates with the new speeds; `implicit` besides takes those forces implicitly
// whose derivative MuJoCo knows, here the gyroscopic ones alone. The wheels' states u, v and b take part as MuJoCo's
// activations: explicit Euler with these two, the same stages as the motion with `rk4`.
enum class MujocoIntegrator { euler, implicit, rk4 };

// How a loop resists being open by r: MuJoCo asks for r'' = -damping r' - stiffness r, and lets the other forces have
// the part 1 - impedance of what they would do to r without the loop. A load so opens it in proportion to
// (1 - impedance) / stiffness.
struct MujocoLoops {
    // solref: time constant [s] and damping ratio or, both negative, -stiffness [1/s^2] and -damping [1/s].
    std::array<double, 2> reference{0.02, 1};
    // solimp: impedance of a closed loop, of one open by more than a width [m], that width, and two numbers for the
    // shape between. The defaults of both are the library's.
    std::array<double, 5> impedance{0.9, 0.95, 0.001, 0.5, 2};

    // As stiff as stays stable with this step, with a margin.
    static MujocoLoops stiffest(MujocoIntegrator integrator, double step);
};

struct MujocoOptions {
    MujocoIntegrator integrator = MujocoIntegrator::rk4;
    double step = 1e-3;  // [s]
    MujocoLoops loops;
};

class MujocoCar {
public:
    // Throws std::runtime_error with MuJoCo's message if it rejects the car, std::invalid_argument if the car has
    // something that this engine does not support.
    MujocoCar(const VehicleDescription& description, const Road& road, const MujocoOptions& options);
    ~MujocoCar();

    // For `set_state`; zero until set. `advance` leaves its last inputs here.
    void set_inputs(const Inputs& inputs);

    // Closes the loops for the struts' slides, their rates and the current rack input, whatever their angles are. Throws
    // std::runtime_error where the linkage does not reach, std::out_of_range if a suspension is missing.
    void set_state(const CarState& state);

    CarState state() const;

    // MuJoCo's integrator with its fixed step. `inputs` is called, from within MuJoCo, at the times of every evaluation
    // and must not throw. Throws std::runtime_error if MuJoCo loses the motion; it is then back at its design position.
    void advance(double t0, int steps, const std::function<Inputs(double)>& inputs);

    // Largest opening of any loop at any step since set_state: how much longer or shorter than it should be a tie rod
    // is, or one of the two rods that a control arm is made of [m].
    double worst_loop_opening() const;

private:
    struct Engine;
    std::unique_ptr<Engine> engine_;
};

}  // namespace hamilcar::oracle
