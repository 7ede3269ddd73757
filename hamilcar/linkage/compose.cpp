#include "hamilcar/linkage/compose.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace hamilcar {

namespace {

const Vec3<double> x_axis = Vec3<double>::UnitX(), y_axis = Vec3<double>::UnitY(), z_axis = Vec3<double>::UnitZ();

// Appends a joint's coordinates, each on the previous frame.
void add_coordinates(const TreeJointDescription& joint, int parent, std::vector<LinkageCoordinate<double>>& to) {
    const Vec3<double> point = vec3(joint.point), axis = vec3(joint.axis);
    bool turned = false;  // by one of the joint's own
    const auto add = [&](bool slides, const Vec3<double>& direction) {
        to.push_back({slides ? 1 : 0, parent, turned ? 1 : 0, point, direction});
        parent = static_cast<int>(to.size());
        turned = !slides;
    };
    const auto add_rotations = [&] { add(false, z_axis), add(false, x_axis), add(false, y_axis); };
    switch (joint.kind) {
        case TreeJoint::revolute: return add(false, axis);
        case TreeJoint::prismatic: return add(true, axis);
        case TreeJoint::universal: add(false, axis); return add(false, vec3(joint.second_axis));
        case TreeJoint::spherical: return add_rotations();
        case TreeJoint::free: add(true, x_axis), add(true, y_axis), add(true, z_axis); return add_rotations();
    }
}

// Two unit vectors normal to a third.
std::pair<Vec3<double>, Vec3<double>> across(const Vec3<double>& axis) {
    const Vec3<double> aside = std::abs(axis[2]) < 0.9 ? z_axis : x_axis;
    const Vec3<double> first = axis.cross(aside).normalized();
    return {first, axis.cross(first)};
}

void add_equations(const CutJointDescription& cut, int part, int base, std::vector<LoopEquation<double>>& to) {
    const Vec3<double> tip = vec3(cut.tip), foot = vec3(cut.foot), axis = vec3(cut.axis), drive = vec3(cut.drive);
    const auto plane = [&](const Vec3<double>& normal) { to.push_back({1, part, base, tip, foot, normal, drive, 0}); };
    const auto distance = [&](const Vec3<double>& from) {
        to.push_back({0, part, base, tip, from, z_axis, drive, cut.length.value_or((tip - from).norm())});
    };
    switch (cut.kind) {
        case CutJoint::distance: return distance(foot);
        case CutJoint::plane: return plane(axis);
        case CutJoint::line: plane(across(axis).first); return plane(across(axis).second);
        case CutJoint::spherical: plane(x_axis), plane(y_axis); return plane(z_axis);
        case CutJoint::revolute_spherical: {
            const Vec3<double> nearest = foot + axis * cut.offset.value_or(axis.dot(tip - foot));
            to.push_back({1, part, base, tip, nearest, axis, drive, 0});
            return distance(nearest);
        }
    }
}

// Tables without a partition: every coordinate counts as independent.
Linkage<double> tables(const LinkageDescription& d) {
    Linkage<double> out;
    for (const TreeJointDescription& joint : d.joints) {
        add_coordinates(joint, frame_of_part(d, joint.parent), out.coordinates);
    }
    for (const CutJointDescription& cut : d.cuts) {
        add_equations(cut, frame_of_part(d, cut.part), frame_of_part(d, cut.base), out.equations);
    }
    out.path.assign(out.coordinates.size() + 1, 0);
    for (std::size_t k = 0; k < out.coordinates.size(); ++k) {
        out.path[k + 1] = out.path[static_cast<std::size_t>(out.coordinates[k].parent)] | (1 << k);
    }
    out.independent.resize(out.coordinates.size());
    std::iota(out.independent.begin(), out.independent.end(), 0);
    return out;
}

// Phi_q at design with rows of length one; angles count as 0.3 m of arc, about an arm's length.
Eigen::MatrixXd scaled_jacobian(const Linkage<double>& linkage) {
    const std::vector<double> q(linkage.coordinates.size(), 0.0);
    LinkagePosition<double> at;
    linkage.find_loops(q.data(), q.data(), RackMotion<double>{}, at);
    Eigen::MatrixXd Phi_q(linkage.equations.size(), linkage.coordinates.size());
    for (int e = 0; e < Phi_q.rows(); ++e) {
        for (int k = 0; k < Phi_q.cols(); ++k) {
            Phi_q(e, k) = linkage.entry(at, e, k) / (linkage.coordinates[static_cast<std::size_t>(k)].slides ? 1 : 0.3);
        }
        const double norm = Phi_q.row(e).norm();
        if (norm > 0) Phi_q.row(e) /= norm;
    }
    return Phi_q;
}

constexpr double rank_tolerance = 1e-6;

// The cut joints whose equations are linearly dependent.
std::string redundant_cuts(const LinkageDescription& d, const Eigen::MatrixXd& Phi_q) {
    Eigen::FullPivLU<Eigen::MatrixXd> lu(Phi_q.transpose());
    lu.setThreshold(rank_tolerance);
    const Eigen::MatrixXd left = lu.kernel();
    std::string names;
    int row = 0;
    for (const CutJointDescription& cut : d.cuts) {
        const int count = equations(cut.kind);
        if (left.middleRows(row, count).cwiseAbs().maxCoeff() > 1e-3)
            names += (names.empty() ? "'" : ", '") + cut.name + "'";
        row += count;
    }
    return names;
}

// The part that moves most while all wheels keep their height.
std::string loose_part(const LinkageDescription& d, const Linkage<double>& linkage, const Eigen::MatrixXd& Phi_q,
                       const std::vector<PartPoint>& wheels) {
    const std::vector<double> q(linkage.coordinates.size(), 0.0);
    LinkagePosition<double> at;
    linkage.find_loops(q.data(), q.data(), RackMotion<double>{}, at);
    Eigen::MatrixXd held(Phi_q.rows() + static_cast<Eigen::Index>(wheels.size()), Phi_q.cols());
    held.topRows(Phi_q.rows()) = Phi_q;
    for (std::size_t i = 0; i < wheels.size(); ++i) {
        const int path = linkage.path[static_cast<std::size_t>(frame_of_part(d, wheels[i].part))];
        const Vec3<double> from_anchor = vec3(wheels[i].point) - linkage.anchor();
        for (int k = 0; k < held.cols(); ++k) {
            const double rise = velocity_at<double>(at.B[static_cast<std::size_t>(k)], from_anchor)[2];
            held(Phi_q.rows() + static_cast<Eigen::Index>(i), k) = ((path >> k) & 1) ? rise : 0;
        }
    }
    Eigen::FullPivLU<Eigen::MatrixXd> lu(held);
    lu.setThreshold(rank_tolerance);
    const Eigen::MatrixXd free = lu.kernel();
    std::string loosest;
    double largest = 0;
    for (std::size_t part = d.joints.size(); part > 0; --part) {
        const int own = freedoms(d.joints[part - 1].kind), last = frame_of_part(d, part);
        const double moves = free.middleRows(last - own, own).norm();
        if (moves > largest + 1e-9) largest = moves, loosest = d.joints[part - 1].part;
    }
    return loosest;
}

// A partly eliminated matrix, with the entries that may be nonzero in any position of the linkage.
struct Elimination {
    Eigen::MatrixXd A;
    Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> filled;
    std::vector<int> rows, columns;  // remaining

    // Among pivots of at least a fifth of the largest, the one with the least fill-in (Markowitz 1957).
    std::pair<int, int> best() const {
        double largest = 0;
        for (const int r : rows) {
            for (const int c : columns) largest = std::max(largest, std::abs(A(r, c)));
        }
        std::pair<int, int> best{rows.front(), columns.front()};
        long min_fill = std::numeric_limits<long>::max();
        for (const int r : rows) {
            for (const int c : columns) {
                if (!(std::abs(A(r, c)) >= 0.2 * largest)) continue;
                const auto in_row = std::ranges::count_if(columns, [&](int other) { return filled(r, other); });
                const auto in_column = std::ranges::count_if(rows, [&](int other) { return filled(other, c); });
                const long fill = (in_row - 1) * (in_column - 1);
                if (fill < min_fill) min_fill = fill, best = {r, c};
            }
        }
        return best;
    }
    void eliminate(int row, int column) {
        std::erase(rows, row), std::erase(columns, column);
        for (const int r : rows) {
            const double factor = A(row, column) == 0 ? 0 : A(r, column) / A(row, column);
            for (const int c : columns) {
                A(r, c) -= factor * A(row, c);
                filled(r, c) = filled(r, c) || (filled(r, column) && filled(row, c));
            }
        }
    }
};

// Chosen once, at design, for the sparsity of this linkage: a step exchanges rows only where these pivots are too small
// (math/small_solve.hpp).
void choose_pivots(Linkage<double>& linkage) {
    const int n = std::min(linkage.nW(), static_cast<int>(linkage.equations.size()));
    const Eigen::MatrixXd Phi_q = scaled_jacobian(linkage);
    Elimination left{Eigen::MatrixXd(n, n), {}, {}, {}};
    left.filled.resize(n, n);
    for (int e = 0; e < n; ++e) {
        for (int i = 0; i < n; ++i) {
            left.A(e, i) = Phi_q(e, linkage.dependent[static_cast<std::size_t>(i)]);
            left.filled(e, i) = linkage.sign(e, linkage.dependent[static_cast<std::size_t>(i)]) != 0;
        }
        left.rows.push_back(e), left.columns.push_back(e);
    }
    for (int k = 0; k < n; ++k) {
        const auto [row, column] = left.best();
        linkage.pivot_equation.push_back(row), linkage.pivot_dependent.push_back(column);
        left.eliminate(row, column);
    }
}

}  // namespace

int frame_of_part(const LinkageDescription& linkage, std::size_t part) {
    int frame = 0;
    for (std::size_t joint = 0; joint < part; ++joint) frame += freedoms(linkage.joints[joint].kind);
    return frame;
}

PartitionResult choose_partition(const LinkageDescription& d, const std::vector<PartPoint>& wheels) {
    const int expected = static_cast<int>(wheels.size());
    const Linkage<double> linkage = tables(d);
    const Eigen::MatrixXd Phi_q = scaled_jacobian(linkage);
    const int coordinates = static_cast<int>(Phi_q.cols()), equations = static_cast<int>(Phi_q.rows());
    PartitionResult out;
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(Phi_q);
    qr.setThreshold(rank_tolerance);
    const int rank = equations > 0 ? static_cast<int>(qr.rank()) : 0;
    out.degrees_of_freedom = coordinates - rank;
    if (rank < equations) {
        out.problem = "redundant cut joints: " + redundant_cuts(d, Phi_q) + " add " + std::to_string(equations - rank) +
                      " dependent equation(s)";
    } else if (expected > 0 && out.degrees_of_freedom > expected) {
        out.problem = std::to_string(out.degrees_of_freedom - expected) + " cut equation(s) too few: '" +
                      loose_part(d, linkage, Phi_q, wheels) + "' is loose";
    } else if (out.degrees_of_freedom < expected) {
        out.problem =
            std::to_string(expected - out.degrees_of_freedom) + " cut equation(s) too many: the wheels cannot move";
    }
    std::vector<bool> dependent(static_cast<std::size_t>(coordinates), false);
    for (int i = 0; i < rank; ++i) dependent[static_cast<std::size_t>(qr.colsPermutation().indices()[i])] = true;
    for (int k = 0; k < coordinates; ++k) {
        if (!dependent[static_cast<std::size_t>(k)]) out.independent.push_back(k);
    }
    return out;
}

Linkage<double> compose(const LinkageDescription& d) {
    Linkage<double> out = tables(d);
    out.independent = d.independent;
    if (out.independent.empty()) {
        out.independent = choose_partition(d, {}).independent;
    }
    for (int k = 0; k < out.nq(); ++k) {
        if (std::find(out.independent.begin(), out.independent.end(), k) == out.independent.end()) {
            out.dependent.push_back(k);
        }
    }
    choose_pivots(out);
    return out;
}

}  // namespace hamilcar
