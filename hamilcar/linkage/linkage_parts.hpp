// The tables of a linkage, and the results for one position and one motion.
#pragma once

#include <array>
#include <tuple>
#include <vector>

#include "hamilcar/linkage/frame.hpp"

namespace hamilcar {

inline constexpr int max_coordinates = 12;  // of one linkage
inline constexpr int max_equations = 9;
inline constexpr int max_freedoms = 3;  // independent coordinates
inline constexpr int max_frames = max_coordinates + 1;

// One coordinate: its frame turns about an axis of the parent frame or slides along it; zero at design.
template <class T>
struct LinkageCoordinate {
    int slides;           // 1 [m], or 0: turns [rad]
    int parent;           // frame
    int same_point;       // 1: turns about the same point as its parent frame does
    Vec3<T> point, axis;  // in the parent, at design
    static constexpr auto members() {
        using F = LinkageCoordinate;
        return std::tuple(&F::slides, &F::parent, &F::same_point, &F::point, &F::axis);
    }
};

// One equation between a point of `part` and a point of `base`, which the rack may move.
template <class T>
struct LoopEquation {
    int plane;          // 1: axis . (tip - foot) = 0 with the axis fixed in the base; 0: |tip - foot|^2 = length^2
    int part, base;     // frames
    Vec3<T> tip, foot;  // at design
    Vec3<T> axis;       // of a plane, unit
    Vec3<T> drive;      // the foot moves by this times the rack's displacement [1]
    T length;           // of a distance [m]
    static constexpr auto members() {
        using E = LoopEquation;
        return std::tuple(&E::plane, &E::part, &E::base, &E::tip, &E::foot, &E::axis, &E::drive, &E::length);
    }
};

// Motions of a linkage's frames: J per rate of the independent coordinates, x prescribed by the rack.
template <class T>
struct FrameMotions {
    std::array<Matrix<T, 6, max_freedoms>, max_frames> J;
    std::array<Spatial<T>, max_frames> x;
    FrameMotions() {}
};

template <class T>
struct LinkagePosition {
    std::array<Placement<T>, max_frames> pose;               // [0] is the chassis
    std::array<Spatial<T>, max_coordinates> B;               // about the anchor
    std::array<Vec3<T>, max_equations> arm, span, gradient;  // P from the anchor, P - foot, g
    std::array<Spatial<T>, max_equations> wrench;            // (g ; arm x g)
    std::array<T, max_equations> Phi, correction;            // (25); -Phi_w^-1 Phi
    Matrix<T, max_equations, max_equations> Phi_w_inverse;
    T determinant;  // of Phi_w in the order of its pivots
    std::array<std::array<T, max_freedoms>, max_coordinates>
        Y;                             // (1 ; H): rate of every coordinate per independent one
    std::array<T, max_coordinates> X;  // of every coordinate  // (39)
    FrameMotions<T> own;               // about the anchor
    FrameMotions<T> motion;            // about the chassis origin
    T pace;  // X and x times this are rates: 1, or the rack's rate where they are per unit of it
    LinkagePosition() {}
};

template <class T>
struct LinkageRates {
    std::array<T, max_coordinates> q;
    std::array<Spatial<T>, max_frames> v;          // of the frames relative to the chassis, about the anchor
    std::array<Spatial<T>, max_coordinates> B;     // B'
    std::array<Spatial<T>, max_equations> wrench;  // w'
    FrameMotions<T> own;                           // Z, and sum B' X in x, about the anchor
    FrameMotions<T> motion;                        // J' about the chassis origin
    LinkageRates() {}
};

// A line of force: its length, the length's gradient by the independent coordinates, and its rate from the prescribed motion.
template <class T>
struct LineOfAction {
    T length, prescribed_rate;
    std::array<T, max_freedoms> gradient;
    LineOfAction() {}
};

// From a point of `base` to a point of `part`, or along a coordinate.
template <class T>
struct ForceLine {
    int part, base, coordinate;  // frames; the coordinate, or -1
    Vec3<T> on_part, on_base;    // at design
    T at_design;                 // length along the coordinate
    static constexpr auto members() {
        using L = ForceLine;
        return std::tuple(&L::part, &L::base, &L::coordinate, &L::on_part, &L::on_base, &L::at_design);
    }
};

}  // namespace hamilcar
