// From a linkage as people describe it to the tables of a Linkage: joints become coordinates, cut joints equations.
#pragma once

#include <string>

#include "hamilcar/description/linkage.hpp"
#include "hamilcar/linkage/linkage.hpp"
#include "hamilcar/math/convert.hpp"

namespace hamilcar {

// The frame of a part: that of its joint's last coordinate; 0 for part 0.
int frame_of_part(const LinkageDescription& linkage, std::size_t part);

// The tables in doubles, partitioned as described or, if the description leaves it open, as `choose_partition` does.
Linkage<double> compose(const LinkageDescription& linkage);

// The same for any number.
template <class T>
Linkage<T> compose_for(const LinkageDescription& linkage) {
    if constexpr (std::is_same_v<T, double>) {
        return compose(linkage);
    } else {
        const Linkage<double> one = compose(linkage);
        Linkage<T> out;
        for (const auto& f : one.freedoms) {
            out.freedoms.push_back({f.slides, f.parent, f.same_point, as<T>(f.point), as<T>(f.axis)});
        }
        for (const auto& e : one.equations) {
            out.equations.push_back(
                {e.plane, e.part, e.base, as<T>(e.tip), as<T>(e.foot), as<T>(e.axis), as<T>(e.drive), T(e.length)});
        }
        out.independent = one.independent, out.dependent = one.dependent, out.path = one.path;
        out.pivot_equation = one.pivot_equation, out.pivot_dependent = one.pivot_dependent;
        return out;
    }
}

// A wheel's center, on its carrier.
struct CarriedPoint {
    std::size_t part;
    Point point;
};

// What the Jacobian at design says of a linkage that is to leave every wheel one freedom.
struct LinkageVerdict {
    std::vector<int> independent;  // coordinates
    int freedoms = 0;              // coordinates less independent equations
    std::string problem;  // empty, or what is wrong: how many cuts are missing and which part is loose, or redundant
};

// The rack stands still in the middle. Dependent become the coordinates that the equations hold best: the first pivots of a
// QR decomposition with column pivoting. Without wheels there is no problem.
LinkageVerdict choose_partition(const LinkageDescription& linkage, const std::vector<CarriedPoint>& wheels);

}  // namespace hamilcar
