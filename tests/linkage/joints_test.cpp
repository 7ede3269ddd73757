// What makes a tree joint a joint, whatever its kind: the identity at design, columns that are the motion of its pose, and
// rates that are the rates of those columns. A new joint is one line at the end of this file.
#include <gtest/gtest.h>

#include "hamilcar/linkage/tree.hpp"
#include "linkage/motion.hpp"

namespace hamilcar {
namespace {

constexpr double exact = 1e-15;          // one or two roundings of numbers below one
constexpr double by_difference = 1e-10;  // fourth-order differences at a step of 1e-3, entries of order one
constexpr std::array times{0.0, 0.7, 1.9};

// A motion that visits coordinates to both sides of design, every coordinate with another rhythm.
template <std::size_t n>
std::array<double, n> coordinates_at(double t, std::array<double, n> design) {
    for (std::size_t i = 0; i < n; ++i) design[i] += 0.6 * std::sin((0.8 + 0.3 * i) * t + 0.4 + i);
    return design;
}
template <std::size_t n>
std::array<double, n> rates_at(double t) {
    std::array<double, n> rate;
    for (std::size_t i = 0; i < n; ++i) rate[i] = 0.6 * (0.8 + 0.3 * i) * std::cos((0.8 + 0.3 * i) * t + 0.4 + i);
    return rate;
}

template <class Joint>
using DesignOf = std::array<double, static_cast<std::size_t>(Joint::coordinates)>;

// What a joint hangs on: the chassis itself, or another joint in motion.
struct OnChassis {
    ChassisFrame<double> parent(double) const { return {}; }
    Pose<double> pose(double) const { return {Mat3<double>::Identity(), Vec3<double>::Zero()}; }
    Rest motion(double, const Vec3<double>&) const { return {}; }
};

template <class Lead>
struct OnJoint {
    Lead lead;
    DesignOf<Lead> design;
    Pose<double> pose(double t) const {
        return lead.place(ChassisFrame<double>{}, coordinates_at(t + 0.5, design).data(), Vec3<double>(0, 0, 0)).child;
    }
    Pose<double> parent(double t) const { return pose(t); }
    // About the anchor.
    Screw<double> motion(double t, const Vec3<double>& anchor) const {
        const Spatial<double> v = test::motion_of([&](double at) { return pose(at); }, t);
        return {velocity_at<double>(v, anchor), v.tail<3>()};
    }
};

// A joint on the chassis stands on the anchor; any other has it somewhere else.
template <class Joint>
Vec3<double> anchor_of(const OnChassis&, const Joint& joint) {
    if constexpr (requires { joint.point; }) {
        return joint.point;
    } else {
        return Vec3<double>::Zero();
    }
}
template <class Lead, class Joint>
Vec3<double> anchor_of(const OnJoint<Lead>&, const Joint&) {
    return {0.3, -0.7, 0.2};
}

template <class Carrier, class Joint>
auto place(const Carrier& carrier, const Joint& joint, double t, const DesignOf<Joint>& q) {
    return joint.place(carrier.parent(t), q.data(), anchor_of(carrier, joint));
}

// The columns about the chassis origin.
template <class Columns>
auto as_matrix(const Columns& columns, const Vec3<double>& anchor) {
    constexpr int n = static_cast<int>(std::tuple_size_v<Columns>);
    Matrix<double, 6, n> out;
    int i = 0;
    std::apply([&](const auto&... column) { ((out.col(i++) = referred<double>(column, anchor)), ...); }, columns);
    return out;
}

template <class Carrier, class Joint>
void check_design_pose(const Carrier& carrier, const Joint& joint, const DesignOf<Joint>& design) {
    for (const double t : times) {
        EXPECT_LE(test::difference(place(carrier, joint, t, design).child, carrier.pose(t)), 2 * exact);
    }
}

// Coordinate by coordinate with the carrier held.
template <class Carrier, class Joint>
void check_columns(const Carrier& carrier, const Joint& joint, const DesignOf<Joint>& design) {
    for (const double t : times) {
        const auto q = coordinates_at(t, design);
        const auto B = as_matrix(place(carrier, joint, t, q).columns, anchor_of(carrier, joint));
        ASSERT_EQ(B.cols(), Joint::coordinates);
        for (std::size_t i = 0; i < q.size(); ++i) {
            const auto moved = [&](double value) {
                auto varied = q;
                varied[i] = value;
                return place(carrier, joint, t, varied).child;
            };
            const Spatial<double> expected = test::motion_of(moved, q[i]);
            EXPECT_LE((B.col(static_cast<int>(i)) - expected).norm(), by_difference) << "coordinate " << i;
            EXPECT_GE(expected.norm(), 0.9) << "a unit rate must be seen";
        }
    }
}

// Everything in motion: the child's motion and the rates of the joint's columns, from the order outward it declares.
template <class Carrier, class Joint>
void check_carry(const Carrier& carrier, const Joint& joint, const DesignOf<Joint>& design) {
    constexpr int n = Joint::coordinates;
    using Outward = OutwardOrder<Joint>;
    const Vec3<double> anchor = anchor_of(carrier, joint);
    const auto placed_at = [&](double t) { return place(carrier, joint, t, coordinates_at(t, design)); };
    for (const double t : times) {
        const auto rate = rates_at<n>(t);
        const auto [child, outward_rates] =
            carry_tree<Outward>(carrier.motion(t, anchor), placed_at(t).columns, rate.data());
        const Spatial<double> expected = test::motion_of([&](double at) { return placed_at(at).child; }, t);
        EXPECT_LE((referred<double>(child, anchor) - expected).norm(), by_difference);
        const auto columns = [&](double at) { return as_matrix(placed_at(at).columns, anchor); };
        const Matrix<double, 6, n> columns_rate = test::derivative(columns, t),
                                   B_rate = as_matrix(outward_rates, anchor);
        for (std::size_t i = 0; i < n; ++i) {
            const int place = Outward::place[i];
            EXPECT_LE((B_rate.col(place) - columns_rate.col(static_cast<int>(i))).norm(), 10 * by_difference);
        }
    }
}

template <class Carrier, class Joint>
void check_on(const char* place_of_joint, const Carrier& carrier, const Joint& joint, const DesignOf<Joint>& design) {
    SCOPED_TRACE(std::string(Joint::name) + " " + place_of_joint);
    check_design_pose(carrier, joint, design);
    check_columns(carrier, joint, design);
    check_carry(carrier, joint, design);
}

const Vec3<double> slanted = Vec3<double>(0.3, -0.8, 0.5).normalized();

// All laws of a tree joint, alone and behind every other kind.
template <class Joint>
void check_joint(const Joint& joint, const DesignOf<Joint>& design) {
    const Vec3<double> somewhere(-0.4, 0.2, 0.7);
    check_on("on the chassis", OnChassis{}, joint, design);
    check_on("behind a revolute", OnJoint<Revolute<double>>{{somewhere, slanted}, {0}}, joint, design);
    check_on("behind a prismatic", OnJoint<Prismatic<double>>{{slanted, 0.3}, {0.3}}, joint, design);
    check_on("behind a spherical", OnJoint<BryantSpherical<double>>{{somewhere}, {0, 0, 0}}, joint, design);
}

TEST(TreeJoint, Revolute) {
    check_joint(Revolute<double>{{0.1, 0.5, -0.3}, slanted}, {0});
}
TEST(TreeJoint, Prismatic) {
    check_joint(Prismatic<double>{slanted, 0.53}, {0.53});
}
TEST(TreeJoint, BryantSpherical) {
    check_joint(BryantSpherical<double>{{-0.1, 0.5, 0.8}}, {0, 0, 0});
}

}  // namespace
}  // namespace hamilcar
