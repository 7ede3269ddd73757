// From the description of a linkage to the tables of a Linkage: joints become coordinates, cut joints equations.
#pragma once

#include <string>

#include "hamilcar/description/linkage.hpp"
#include "hamilcar/linkage/linkage.hpp"
#include "hamilcar/math/convert.hpp"

namespace hamilcar {

// The frame of a part: that of its joint's last coordinate; 0 for part 0.
int frame_of_part(const LinkageDescription& linkage, std::size_t part);

// The tables in doubles, partitioned as described, or by `choose_partition` if the description does not say.
Linkage<double> compose(const LinkageDescription& linkage);

// The same for any scalar type.
template <class T>
Linkage<T> compose_for(const LinkageDescription& linkage) {
    if constexpr (std::is_same_v<T, double>) {
        return compose(linkage);
    } else {
        const Linkage<double> one = compose(linkage);
        Linkage<T> out;
        for (const auto& f : one.coordinates) {
            out.coordinates.push_back({f.slides, f.parent, f.same_point, as<T>(f.point), as<T>(f.axis)});
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

// A point of a part, such as a wheel's center on its carrier.
struct PartPoint {
    std::size_t part;
    Point point;
};

// What the Jacobian at design says about a linkage that should leave each wheel one degree of freedom.
struct PartitionResult {
    std::vector<int> independent;  // coordinates
    int degrees_of_freedom = 0;    // coordinates less independent equations
    std::string problem;           // empty, or what is wrong: which part is loose, or which cuts are redundant
};

// With the rack centered. The dependent coordinates are those that the equations determine best: the first pivots of a QR
// decomposition with column pivoting. Without wheels no problem is reported.
PartitionResult choose_partition(const LinkageDescription& linkage, const std::vector<PartPoint>& wheels);

}  // namespace hamilcar
