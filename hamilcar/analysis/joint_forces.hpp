// Forces in the joints of a suspension: in its links and arms, ball joints and hinges.
//
// The equations of motion know none: reactions of ideal joints do no work on what the joints allow. Where a tree coordinate k is
// moved and the cut joints are let open they do, so what is unbalanced along the column B_k (unbalanced.hpp) is Phi_q^T lambda:
// one small system for the dependent coordinates, and the independent ones must agree, which is d'Alembert's principle. A cut
// joint's force is lambda times its gradients; a tree joint's is what is unbalanced along the three directions for all that
// it carries, less the cut joints there.
#pragma once

#include "hamilcar/analysis/unbalanced.hpp"
#include "hamilcar/block/static_vector.hpp"
#include "hamilcar/description/vehicle.hpp"

namespace hamilcar {

// Of the two bushes of a hinge on what turns in them, the one that the description names first; each takes half of what acts along
// the axis, which nothing tells apart between rigid bushes. NaN where there are not two [N]
struct BushForces {
    Vec3<double> first, second;
};

// In the order of the description, components in the axes of the unit that carries the suspension.
struct JointForces {
    // Of each tree joint on what it carries, with what acts along a sliding one [N]
    StaticVector<Vec3<double>, max_coordinates> joints;
    StaticVector<BushForces, max_coordinates> joint_bushes;
    StaticVector<Vec3<double>, max_equations> cuts;      // of each cut joint on its part [N]
    StaticVector<BushForces, max_equations> cut_bushes;  // on the arm that a cut joint stands for
    StaticVector<double, max_equations> tension;         // of a cut joint that keeps a distance; NaN of others [N]
    double unbalanced = 0;  // what the independent coordinates lack: the difference's error [N, or N m]
};

JointForces joint_forces(const Unbalanced& of, std::size_t suspension, const LinkageDescription& description);

// Of every suspension, in the vehicle's order.
using VehicleJointForces = StaticVector<JointForces, max_suspensions>;
void joint_forces(const Unbalanced& of, const VehicleDescription& description, VehicleJointForces& out);

}  // namespace hamilcar
