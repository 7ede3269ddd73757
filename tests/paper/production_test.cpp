// Production against the paper: the blocks in chassis axes give what the literal matrices A.2 to A.5 in Bryant angles
// about the earth origin give, for open and closed joints, moving rack, spinning wheels, in both charts, to 1e-10.
#include <gtest/gtest.h>

#include "hamilcar/block/ring.hpp"
#include "paper/literal_fixture.hpp"

namespace hamilcar {
namespace {

using paper::Coordinates;
using paper::LiteralCar;

constexpr double tolerance = 1e-10;           // of the largest number compared
const paper::Rotors rotors{31, -12, 44, 27};  // FR, FL, RR, RL [kg m^2/s]

// Corner i of the description is this body of the paper.
constexpr std::array<int, 4> body_of_corner{3, 2, 5, 4};
constexpr std::array<int, 4> independent_of_corner{8, 4, 10, 9};
constexpr std::array<int, 4> first_dependent_of_corner{5, 1, 0, 0};

void shift(Point& point, const Point& by) {
    for (std::size_t i = 0; i < 3; ++i) point[i] -= by[i];
}

// The paper's car with the vehicle origin in the chassis's center of mass, so that O is the paper's r_1, and with every
// force but gravity switched off: what remains is the mechanics of sections 2 to 5.
VehicleDescription force_free_car() {
    VehicleDescription car = paper::reference_car();
    const Point origin = car.chassis.center_of_mass;
    shift(car.chassis.center_of_mass, origin);
    for (CornerDescription& corner : car.corners) {
        shift(corner.carrier.center_of_mass, origin);
        shift(corner.wheel.center, origin);
        if (auto* m = std::get_if<MacPhersonDescription>(&corner.suspension)) {
            for (Point* p : {&m->strut_top, &m->slide_point, &m->arm_front, &m->arm_rear, &m->ball_joint, &m->rack_end,
                             &m->tie_rod_outer}) {
                shift(*p, origin);
            }
        }
        if (auto* a = std::get_if<SemiTrailingArmDescription>(&corner.suspension)) {
            for (Point* p :
                 {&a->inner_bush, &a->outer_bush, &a->spring_arm, &a->spring_body, &a->damper_arm, &a->damper_body}) {
                shift(*p, origin);
            }
        }
        // Printed to six digits; a file's axis is normalized by its reader.
        const Vec3<double> axis = vec3(corner.wheel.spin_axis).normalized();
        corner.wheel.spin_axis = {axis[0], axis[1], axis[2]};
        corner.spring = {0, 0};
        corner.damper = {{-1, 1}, {0, 0}};
        corner.bump = corner.rebound = {1, 0, 0};
        corner.tire = SpringTireDescription{0.3, 0.3, 0};
        corner.brake = {0, 1, 0};
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
        for (int i = 0; i < 4; ++i) {
            SpokeState<double> spoke = state_.spoke(i);
            spoke.independent[0] = q_(independent_of_corner[i]);
            for (int j = 0; i < 2 && j < 3; ++j) spoke.dependent[j] = q_(first_dependent_of_corner[i] + j);
            spoke.momentum[0] = P[row_in_a(independent_of_corner[i])];
            spoke.spin_momentum = rotors[static_cast<std::size_t>(body_of_corner[i] - 2)];
        }
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

TEST_P(Production, VelocitiesAreThoseOf58) {
    const paper::Vector qdot = literal_.qdot(q_, adot_);
    const Vec3<double> r_rate = velocity_.R_GC * velocity_.hub.head<3>();
    const Vec3<double> omega = velocity_.R_GC * velocity_.hub.tail<3>();
    const Vec3<double> angles(q_(14), q_(15), q_(16));
    const Vec3<double> expected = bryant_rate_matrix(BryantAngles<double>(angles)) * adot_.segment<3>(3);
    for (int i = 0; i < 3; ++i) {
        expect_near(r_rate[i], adot_[i], 3, "chassis velocity");
        expect_near(omega[i], expected[i], 1, "chassis angular velocity");
    }
    const auto momenta = momenta_block(model_, state_, input_, velocity_);
    for (int i = 0; i < 4; ++i) {
        expect_near(momenta.spokes[i].V_rate[0], qdot[row_in_qdot(independent_of_corner[i])], 1, "V'");
        for (int j = 0; i < 2 && j < 3; ++j) {
            expect_near(momenta.spokes[i].W_rate[j], qdot[row_in_qdot(first_dependent_of_corner[i] + j)], 1, "W' (38)");
        }
    }
}

TEST_P(Production, LinkageIsThatOfA3AndOf39) {
    const paper::Matrix H = literal_.H(q_);
    const paper::Vector X = literal_.X(q_), Phi = literal_.Phi(q_);
    for (int corner = 0; corner < 2; ++corner) {
        const auto& at = std::get<SpokeVelocity<double, MacPherson<double>>>(velocity_.spokes[corner]).position;
        const int rows = corner == 0 ? 3 : 0, column = corner == 0 ? 1 : 0;
        for (int i = 0; i < 3; ++i) {
            // Our u points from A1 to A2 as the oracle's does, so even the signs of Phi agree.
            expect_near(at.Phi[i], Phi[rows + i], 1, "Phi (25)");
            expect_near(at.H(i, 0), H(rows + i, column), 1, "H (39)");
            expect_near(at.X[i], X[rows + i], 1, "X (39)");
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
        const Vec3<double> omega = velocity_.R_GC * velocity_.hub.tail<3>();
        P_Z_rate = BryantChart<double>::stored_momentum_rate(
            bryant,
            {velocity_.R_GC * velocity_.hub.head<3>(), omega, velocity_.hub.tail<3>(), state_.momentum(), P_Z_rate});
    }
    for (int i = 0; i < 6; ++i) expect_near(P_Z_rate[i], expected[i], scale, "P_Z'");
    for (int i = 0; i < 4; ++i) {
        expect_near(rate.spoke(i).momentum[0], expected[row_in_a(independent_of_corner[i])], scale, "P_V'");
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
