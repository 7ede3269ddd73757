// Production against the paper: the blocks in chassis axes give what the literal matrices A.2 to A.5 in Bryant angles
// about the earth origin give, for open and closed joints, moving rack, spinning wheels, in both charts, to 1e-10. The
// strut's dependent coordinates are other angles than the paper's: strut_turns.hpp converts.
#include <gtest/gtest.h>

#include "hamilcar/block/rhs.hpp"
#include "paper/literal_fixture.hpp"
#include "paper/strut_turns.hpp"

namespace hamilcar {
namespace {

using paper::Coordinates;
using paper::LiteralCar;

constexpr double tolerance = 1e-10;           // of the largest number compared
const paper::Rotors rotors{31, -12, 44, 27};  // FR, FL, RR, RL [kg m^2/s]

// Suspension i of the description carries this body of the paper.
constexpr std::array<int, 4> body_of{3, 2, 5, 4};
constexpr std::array<int, 4> independent_of{8, 4, 10, 9};
constexpr std::array<int, 2> first_dependent_of{5, 1};  // the front ones alone have any

void shift(Point& point, const Point& by) {
    for (std::size_t i = 0; i < 3; ++i) point[i] -= by[i];
}

// Joints, cut joints and lines of force.
void shift_points(SuspensionDescription& suspension, const Point& by) {
    for (TreeJointDescription& joint : suspension.linkage.joints) {
        shift(joint.point, by);
        if (joint.other_bush) shift(*joint.other_bush, by);
    }
    for (CutJointDescription& cut : suspension.linkage.cuts) {
        shift(cut.tip, by), shift(cut.foot, by);
        if (cut.other_bush) shift(*cut.other_bush, by);
    }
    for (LineDescription* line : {&suspension.springs[0].line, &suspension.dampers[0].line}) {
        shift(line->on_part, by), shift(line->on_base, by);
    }
}

// The paper's car with the vehicle origin in the chassis's center of mass, so that O is the paper's r_1, and with every
// force but gravity switched off: what remains is the mechanics of sections 2 to 5.
VehicleDescription force_free_car() {
    VehicleDescription car = paper::reference_car();
    const Point origin = car.chassis.center_of_mass;
    shift(car.chassis.center_of_mass, origin);
    for (SuspensionDescription& suspension : car.suspensions) {
        shift_points(suspension, origin);
        shift(suspension.bodies[0].body.center_of_mass, origin);
        SuspensionWheelDescription& wheel = suspension.wheels[0];
        shift(wheel.wheel.center, origin);
        // Printed to six digits; a file's axis is normalized by its reader.
        const Vec3<double> axis = vec3(wheel.wheel.spin_axis).normalized();
        wheel.wheel.spin_axis = {axis[0], axis[1], axis[2]};
        wheel.bump = wheel.rebound = {1, 0, 0};
        wheel.tire = SpringTireDescription{0.3, 0.3, 0};
        wheel.brake = {0, 1, 0};
        suspension.springs[0].spring = {0, 0};
        suspension.dampers[0].damper = {{-1, 1}, {0, 0}};
    }
    car.anti_roll_bars.clear();
    car.aerodynamics = {};
    return car;
}

struct Case {
    const char* name;
    ChassisChart chart;
    double alpha;
    bool open_joints;
};

void PrintTo(const Case& test, std::ostream* out) {
    *out << test.name;
}

class Production : public testing::TestWithParam<Case> {
protected:
    Production()
        : description_(force_free_car()),
          literal_(description_, GetParam().alpha),
          adot_(paper::general_rates()),
          q_(GetParam().open_joints ? paper::violated_position(literal_) : paper::general_position(literal_)),
          model_{.vehicle = Vehicle<double>(description_),
                 .road = PlaneRoad<double>(0, 0, 1),
                 .chart = GetParam().chart,
                 .constraints = ConstraintMode::stabilized,
                 .stabilization_gain = GetParam().alpha} {
        input_.rack = {q_(17), q_.q17_dot, 0};
        set_state();
        velocity_ = velocity_block(model_, state_, input_);
    }

    void set_state() {
        const paper::Vector P = literal_.P_a(q_, adot_, rotors);
        state_.position() = Vec3<double>(q_(11), q_(12), q_(13));
        const Vec3<double> angles(q_(14), q_(15), q_(16));
        Vector<double, 4> bryant(q_(14), q_(15), q_(16), 0);
        if (model_.chart == ChassisChart::bryant) {
            state_.orientation() = bryant;
            state_.momentum() = P.head<6>();  // the paper's P_Z itself
        } else {
            const Eigen::Quaterniond q(bryant_rotation(BryantAngles<double>(angles)));
            state_.orientation() << q.w(), q.x(), q.y(), q.z();
            state_.momentum() = BryantChart<double>::momentum(bryant, P.head<6>());
        }
        for (std::size_t i = 0; i < 4; ++i) {
            const auto own = suspension(i).state(state_.values.data());
            const double design = literal_.design_position()(independent_of[i]);  // the strut's length, or zero
            own.independent[0] = q_(independent_of[i]) - design;
            if (i < 2) {
                const Vec3<double> W = paper::linkage_angles(paper::spindle_orientation(strut_angles(i)));
                std::copy_n(W.data(), 3, own.dependent);
            }
            own.momentum[0] = P[row_in_a(independent_of[i])];
            suspension(i).wheel_state(0, state_.values.data()).spin_momentum =
                rotors[static_cast<std::size_t>(body_of[i] - 2)];
        }
    }

    const Suspension<double>& suspension(std::size_t i) const { return model_.vehicle.suspensions[i]; }
    std::size_t carrier(std::size_t i) const { return static_cast<std::size_t>(suspension(i).bodies[0].frame); }
    // The paper's angles of a front suspension.
    Vec3<double> strut_angles(std::size_t i) const {
        const int first = first_dependent_of[i];
        return {q_(first), q_(first + 1), q_(first + 2)};
    }

    static int row_in_a(int coordinate) {
        const auto found = std::find(paper::independent.begin(), paper::independent.end(), coordinate);
        return static_cast<int>(found - paper::independent.begin());
    }
    static int row_in_qdot(int coordinate) {
        const auto found = std::find(paper::coordinate_of_row.begin(), paper::coordinate_of_row.end(), coordinate);
        return static_cast<int>(found - paper::coordinate_of_row.begin());
    }
    static void expect_near(double value, double expected, double scale, const char* what) {
        EXPECT_NEAR(value, expected, tolerance * std::max(1.0, scale)) << what;
    }

    VehicleDescription description_;
    LiteralCar literal_;
    paper::Vector adot_;
    Coordinates q_;
    Model<double> model_;
    Input<double> input_;
    State<double> state_;
    Velocity<double> velocity_;
};

TEST_P(Production, PositionsAreThoseOf4And7) {
    const auto poses = literal_.poses(q_);
    const auto& [A_1, r_1] = poses[0];
    for (std::size_t i = 0; i < 4; ++i) {
        const auto& [A_j, r_j] = poses[static_cast<std::size_t>(body_of[i] - 1)];
        const Placement<double>& pose = velocity_.suspensions[i].at.pose[carrier(i)];
        const paper::Matrix3 R = A_1.transpose() * A_j;
        const Vec3<double> center = A_1.transpose() * (r_j - r_1);
        EXPECT_LE((pose.R - R).cwiseAbs().maxCoeff(), tolerance);
        EXPECT_LE((pose.point(suspension(i).bodies[0].body.center) - center).cwiseAbs().maxCoeff(), tolerance);
    }
}

TEST_P(Production, VelocitiesAreThoseOf58) {
    const paper::Vector qdot = literal_.qdot(q_, adot_);
    const Vec3<double> r_rate = velocity_.R_GC * velocity_.chassis.head<3>();
    const Vec3<double> omega = velocity_.R_GC * velocity_.chassis.tail<3>();
    const Vec3<double> angles(q_(14), q_(15), q_(16));
    const Vec3<double> expected = bryant_rate_matrix(BryantAngles<double>(angles)) * adot_.segment<3>(3);
    for (int i = 0; i < 3; ++i) {
        expect_near(r_rate[i], adot_[i], 3, "chassis velocity");
        expect_near(omega[i], expected[i], 1, "chassis angular velocity");
    }
    const auto momenta = momenta_block(model_, state_, input_, velocity_);
    for (std::size_t i = 0; i < 4; ++i) {
        expect_near(velocity_.suspensions[i].own.V_rate[0], qdot[row_in_qdot(independent_of[i])], 1, "V'");
        if (i >= 2) continue;
        const Vec3<double> angle_rates = qdot.segment<3>(row_in_qdot(first_dependent_of[i]));
        const Vec3<double> W_rate = paper::linkage_rates(strut_angles(i)) * angle_rates;
        for (int j = 0; j < 3; ++j) expect_near(momenta.suspensions[i].W_rate[j], W_rate[j], 1, "W' (38)");
    }
}

TEST_P(Production, LinkageIsThatOfA3AndOf39) {
    const paper::Matrix H = literal_.H(q_);
    const paper::Vector X = literal_.X(q_), Phi = literal_.Phi(q_);
    for (std::size_t i = 0; i < 2; ++i) {
        const LinkagePosition<double>& at = velocity_.suspensions[i].at;
        const Linkage<double>& linkage = suspension(i).linkage;
        const int rows = i == 0 ? 3 : 0, column = i == 0 ? 1 : 0;
        const paper::Matrix3 of_paper = paper::linkage_rates(strut_angles(i));
        const Vec3<double> H_of_paper = of_paper * H.block<3, 1>(rows, column),
                           X_of_paper = of_paper * X.segment<3>(rows);
        for (int j = 0; j < 3; ++j) {
            // Our u points from A1 to A2 as the oracle's does, so even the signs of Phi agree.
            expect_near(at.Phi[j], Phi[rows + j], 1, "Phi (25)");
            expect_near(at.Y[linkage.dependent[j]][0], H_of_paper[j], 1, "H (39)");
            expect_near(at.X[linkage.dependent[j]], X_of_paper[j], 1, "X (39)");
        }
    }
}

// J and x of the carriers, and J' as the chassis sees it, from velocities (v ; w) of the centers of mass in ground axes.
TEST_P(Production, MotionsAreThoseOf43And71) {
    const paper::Matrix v_w = literal_.DI(q_) * literal_.BH(q_), v_w_rate = literal_.DI_BH_dot(q_, adot_);
    const paper::Vector x_of_paper = literal_.DI(q_) * literal_.BX(q_);
    const auto poses = literal_.poses(q_);
    const auto twists = literal_.twists(q_, literal_.qdot(q_, adot_));
    const paper::Matrix3 to_chassis = poses[0].A.transpose();
    for (std::size_t i = 0; i < 4; ++i) {
        const auto body = static_cast<std::size_t>(body_of[i] - 1);
        const int row = 6 * static_cast<int>(body), column = row_in_a(independent_of[i]);
        const Vec3<double> arm = poses[body].r - poses[0].r, arm_rate = twists[body].r_dot - twists[0].r_dot;
        const auto about_chassis = [&](const Spatial<double>& v) {
            return spatial<double>(to_chassis * (v.head<3>() - v.tail<3>().cross(arm)), to_chassis * v.tail<3>());
        };
        const Spatial<double> given = v_w.block<6, 1>(row, column), rate = v_w_rate.block<6, 1>(row, column);
        const Spatial<double> J = about_chassis(given), x = about_chassis(x_of_paper.segment<6>(row));
        const Vec3<double> w = given.tail<3>(), turning = to_chassis * twists[0].omega;
        Spatial<double> J_rate = about_chassis(rate);
        J_rate.head<3>() -= to_chassis * w.cross(arm_rate) + turning.cross(J.head<3>().eval());
        J_rate.tail<3>() -= turning.cross(J.tail<3>().eval());

        const SuspensionVelocity<double>& at = velocity_.suspensions[i];
        LinkageRates<double> rates;
        suspension(i).linkage.find_rates(at.at, at.own.V_rate, input_.rack, rates);
        for (int k = 0; k < 6; ++k) {
            expect_near(at.at.motion.J[carrier(i)](k, 0), J[k], 1, "J (43)");
            expect_near(at.at.motion.x[carrier(i)][k], x[k], 1, "x (43)");
            expect_near(rates.motion.J[carrier(i)](k, 0), J_rate[k], J_rate.cwiseAbs().maxCoeff(), "J' (71)");
        }
    }
}

TEST_P(Production, MomentumRatesAreThoseOf71) {
    const paper::Vector expected = literal_.P_a_dot(q_, adot_, literal_.gravity(q_), rotors);
    const double scale = expected.cwiseAbs().maxCoeff();
    State<double> rate;
    rate_of_state(model_, state_, velocity_, momenta_block(model_, state_, input_, velocity_), rate);
    Spatial<double> P_Z_rate = rate.momentum();
    if (model_.chart == ChassisChart::quaternion) {  // (p', L') to P_Z' by the Bryant chart's own formula
        Vector<double, 4> bryant(q_(14), q_(15), q_(16), 0);
        const Vec3<double> omega = velocity_.R_GC * velocity_.chassis.tail<3>();
        P_Z_rate = BryantChart<double>::stored_momentum_rate(
            bryant, {velocity_.R_GC * velocity_.chassis.head<3>(), omega, velocity_.chassis.tail<3>(),
                     state_.momentum(), P_Z_rate});
    }
    for (int i = 0; i < 6; ++i) expect_near(P_Z_rate[i], expected[i], scale, "P_Z'");
    for (std::size_t i = 0; i < 4; ++i) {
        const auto own = suspension(i).state(rate.values.data());
        expect_near(own.momentum[0], expected[row_in_a(independent_of[i])], scale, "P_V'");
    }
}

INSTANTIATE_TEST_SUITE_P(Paper, Production,
                         testing::Values(Case{"bryant_closed", ChassisChart::bryant, 0, false},
                                         Case{"bryant_open_stabilized", ChassisChart::bryant, 60, true},
                                         Case{"quaternion_closed", ChassisChart::quaternion, 0, false},
                                         Case{"quaternion_open_stabilized", ChassisChart::quaternion, 400, true}),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace hamilcar
