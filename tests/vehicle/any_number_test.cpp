// Every model with the recording scalar type: the recorded program gives the same bits as doubles, in a lane beside another car
// in another situation. A model that takes a branch on a number, or looks into a table by one,
// fails here; a new one is tried as soon as some vehicle of `cars` has it.
#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <set>

#include "hamilcar/program/executable.hpp"
#include "hamilcar/scalar/dispatch.hpp"
#include "hamilcar/vehicle/vehicle.hpp"
#include "support/car.hpp"
#include "support/tires.hpp"

namespace hamilcar {
namespace {

using Recorded = Traced<>;

// Two cars of one topology and with nothing else in common, for the two lanes.
struct Cars {
    VehicleDescription one, other;
};

VehicleDescription stretched(VehicleDescription car) {
    car.chassis.mass *= 1.1;
    for (SuspensionDescription& suspension : car.suspensions) {
        suspension.wheels[0].wheel.center[1] *= 1.02;
        suspension.springs[0].spring.rate *= 1.3;
        suspension.wheels[0].brake.max_torque *= 0.8;
        if (suspension.dampers[0].damper.force.size() > 1) suspension.dampers[0].damper.force.back() *= 2;
        if (!suspension.linkage.cuts.empty()) suspension.linkage.cuts[0].tip[2] += 0.01;  // the control arm's ball
        suspension.linkage.joints[0].point[2] += 0.01;
        test::stretch(suspension.wheels[0].tire, 1.05);
    }
    return car;
}

std::vector<Cars> cars() {
    const VehicleDescription shipped = test::paper_car(), conservative = test::conservative_car();
    std::vector<Cars> out{{shipped, stretched(shipped)}, {conservative, stretched(conservative)}};
    const std::vector<TireDescription> tires = test::slip_tires();
    const std::size_t wheels = shipped.suspensions.size();
    for (std::size_t first = 0; first < tires.size(); first += wheels) {  // a tire of another model at each suspension
        VehicleDescription mixed = shipped;
        for (std::size_t i = 0; i < wheels; ++i) {
            mixed.suspensions[i].wheels[0].tire = tires[(first + i) % tires.size()];
        }
        out.push_back({mixed, stretched(mixed)});
    }
    return out;
}

// The results of a model, number by number.
template <class T>
struct Answers {
    std::vector<T> numbers;
    void add(const T& number) { numbers.push_back(number); }
    template <int rows, int columns>
    void add(const Matrix<T, rows, columns>& m) {
        for (int i = 0; i < m.size(); ++i) numbers.push_back(m.data()[i]);
    }
};

std::uint64_t bits(double number) {
    return std::bit_cast<std::uint64_t>(number);
}

// Of two cars, each number a parameter, and a situation of `size` numbers: records what `ask(vehicle, situation)` answers, and runs
// it with a car in each lane.
class RecordedPair {
public:
    template <class Ask>
    RecordedPair(const Vehicle<double>& one, const Vehicle<double>& other, std::size_t size, const Ask& ask) {
        const Tracing tracing(graph_);
        Vehicle<Recorded> vehicle;
        transcribe(vehicle, one, Parameters{graph_, parameters_[0]});
        Vehicle<double> copy;
        transcribe(copy, other, Collect{parameters_[1]});
        std::vector<Recorded> situation;
        for (std::size_t k = 0; k < size; ++k) situation.push_back(Recorded::of(graph_.input(1, static_cast<int>(k))));
        const std::vector<Recorded> answers = ask(vehicle, situation.data());
        for (std::size_t k = 0; k < answers.size(); ++k) graph_.output(2, static_cast<int>(k), answers[k].id());
        answer_count_ = answers.size();
        executable_ = program::backends().back().compile(graph_, true);
    }
    std::size_t answer_count() const { return answer_count_; }

    // The answers of lane 0, the first car's, and of lane 1.
    std::array<std::vector<double>, 2> run(const std::vector<double>& here, const std::vector<double>& there) const {
        const auto lanes = static_cast<std::size_t>(executable_->lanes());
        const auto spread = [&](const std::vector<double>& first, const std::vector<double>& second) {
            std::vector<double> out;
            for (std::size_t k = 0; k < first.size(); ++k) {
                for (std::size_t l = 0; l < lanes; ++l) out.push_back(l == 1 ? second[k] : first[k]);
            }
            return out;
        };
        std::vector<double> parameters = spread(parameters_[0], parameters_[1]), situation = spread(here, there);
        std::vector<double> answers(answer_count_ * lanes);
        program::Frame frame;
        frame.arrays[0] = parameters.data(), frame.arrays[1] = situation.data(), frame.arrays[2] = answers.data();
        executable_->run(frame);
        std::array<std::vector<double>, 2> out;
        for (std::size_t k = 0; k < answer_count_; ++k) {
            for (std::size_t l = 0; l < 2; ++l) out[l].push_back(answers[k * lanes + l]);
        }
        return out;
    }

private:
    struct Collect {
        std::vector<double>& to;
        double number(double value) { return to.push_back(value), value; }
        int whole(int value) { return value; }
    };
    struct Parameters {
        program::Graph& graph;
        std::vector<double>& values;
        Recorded number(double value) {
            values.push_back(value);
            return Recorded::of(graph.input(0, static_cast<int>(values.size()) - 1));
        }
        int whole(int value) { return value; }
    };

    program::Graph graph_;
    std::array<std::vector<double>, 2> parameters_;
    std::size_t answer_count_ = 0;
    std::unique_ptr<program::Executable> executable_;
};

// A lane may have lost the sign of a zero.
void expect_same(const std::vector<double>& lane, const std::vector<double>& alone, const std::string& what) {
    ASSERT_EQ(lane.size(), alone.size());
    ASSERT_GT(alone.size(), 0u);
    for (std::size_t k = 0; k < alone.size(); ++k) {
        const bool same = bits(lane[k]) == bits(alone[k]) || lane[k] == alone[k];
        EXPECT_TRUE(same) << what << ", answer " << k << ": " << lane[k] << " and " << alone[k];
    }
}

// `ask(suspension, situation)` answers for a Suspension of any number; each of each car is asked in pairs of situations.
template <class Ask>
void expect_same_on_any_number(const Ask& ask) {
    std::mt19937 source(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (const Cars& two_cars : cars()) {
        const Vehicle<double> one(two_cars.one), other(two_cars.other);
        for (std::size_t i = 0; i < one.suspensions.size(); ++i) {
            const auto ask_suspension = [&]<class T>(const Vehicle<T>& vehicle, const T* situation) {
                std::array<T, 12> x;
                std::copy_n(situation, x.size(), x.begin());
                return ask(vehicle.suspensions[i], x).numbers;
            };
            const RecordedPair pair(one, other, 12, ask_suspension);
            for (int trial = 0; trial < 50; ++trial) {
                std::vector<double> here(12), there(12);
                for (std::size_t k = 0; k < here.size(); ++k) here[k] = unit(source), there[k] = unit(source);
                const auto lanes = pair.run(here, there);
                expect_same(lanes[0], ask_suspension(one, here.data()), "suspension " + std::to_string(i));
                expect_same(lanes[1], ask_suspension(other, there.data()), "suspension " + std::to_string(i));
            }
        }
    }
}

TEST(AnyNumber, CarriesLinkages) {
    expect_same_on_any_number([]<class T>(const Suspension<T>& suspension, const std::array<T, 12>& x) {
        const Linkage<T>& linkage = suspension.linkage;
        std::array<T, max_freedoms> V, V_rate;
        std::array<T, max_equations> W;
        V[0] = T(0.05) * x[0], V_rate[0] = x[3];
        for (std::size_t j = 0; j < 3; ++j) W[j] = T(2) * x[6 + j];  // far enough for every quadrant
        const RackMotion<T> rack{T(0.01) * x[9], x[10], x[11]};
        LinkagePosition<T> at;
        linkage.find_position(V.data(), W.data(), rack, T(30), at);
        LinkageRates<T> rates;
        linkage.find_rates(at, V_rate, rack, rates);
        std::array<Spatial<T>, max_frames> x_rate;
        linkage.find_prescribed_rates(at, rates, rack, T(30), x_rate);
        Answers<T> answers;
        const auto frame = static_cast<std::size_t>(suspension.wheels[0].frame);
        const Pose<T> pose = at.pose[frame].pose();
        answers.add(pose.R), answers.add(pose.p), answers.add(at.determinant);
        answers.add(Spatial<T>(at.motion.J[frame].col(0))), answers.add(at.motion.x[frame]);
        answers.add(Spatial<T>(rates.motion.J[frame].col(0))), answers.add(x_rate[frame]);
        for (std::size_t e = 0; e < static_cast<std::size_t>(linkage.nW()); ++e) {
            answers.add(at.Phi[e]), answers.add(at.correction[e]);
        }
        const LineOfAction<T> line = linkage.line(suspension.springs[0].line, at, V.data(), W.data());
        answers.add(line.length), answers.add(line.gradient[0]), answers.add(line.prescribed_rate);
        return answers;
    });
}

TEST(AnyNumber, CarriesEveryTire) {
    std::set<std::size_t> met;
    expect_same_on_any_number([&]<class T>(const Suspension<T>& suspension, const std::array<T, 12>& x) {
        const SuspensionWheel<T>& wheel = suspension.wheels[0];
        met.insert(wheel.tire.index());
        return dispatch(wheel.tire, [&](const auto& tire) {
            const TangentPlane<T> road{Vec3<T>(T(0.1) * x[0], T(0.1) * x[1], T(1)), T(0.1) * x[2], T(0.9)};
            const Vec3<T> axis(T(0.2) * x[3], T(1), T(0.2) * x[4]);
            const auto frame = contact_frame<T>(road, wheel.wheel.center, axis, tire.radius);
            // In the air and on the ground, rolling, slipping, sliding, either way.
            const auto force = tire.force({.depth = T(0.02) * x[5],
                                           .depth_rate = x[6],
                                           .v_sx = T(5) * x[7],
                                           .v_sy = T(5) * x[8],
                                           .v_x = T(30) * x[9],
                                           .camber = T(0.2) * x[4],
                                           .omega = T(100) * x[9],
                                           .friction = T(0.9),
                                           .u = T(0.02) * x[10],
                                           .v = T(0.02) * x[11]});
            Answers<T> answers;
            answers.add(frame.point), answers.add(frame.longitudinal), answers.add(frame.lateral);
            for (const T& number : {frame.depth, frame.lever, force.Fx, force.Fy, force.Fz, force.elastic,
                                    force.rolling_moment, force.Mx, force.Mz, force.u_rate, force.v_rate}) {
                answers.add(number);
            }
            return answers;
        });
    });
    EXPECT_EQ(met.size(), std::variant_size_v<Tire<double>>) << "no vehicle here has some tire of the list";
}

// One car on its roof, the other above the road: the lane in the air must not be affected by its neighbor.
TEST(AnyNumber, CarriesTheHull) {
    const auto contact = []<class T>(const Vehicle<T>& vehicle, const T& height) {
        const TangentPlane<T> road{Vec3<T>(T(0.1), T(0.2), T(-0.97)), -height, T(0.9)};
        const auto found = vehicle.hull.contact(road, Spatial<T>::Constant(T(0.7)));
        Answers<T> answers;
        answers.add(found.wrench), answers.add(found.lost_power);
        return answers.numbers;
    };
    for (const Cars& two_cars : cars()) {
        const Vehicle<double> one(two_cars.one), other(two_cars.other);
        const auto ask = [&]<class T>(const Vehicle<T>& vehicle, const T* height) { return contact(vehicle, *height); };
        const RecordedPair pair(one, other, 1, ask);
        for (const auto& [here, there] : {std::pair(-1.0, 5.0), std::pair(5.0, -1.0), std::pair(-1.0, -2.0)}) {
            const auto lanes = pair.run({here}, {there});
            const auto first = contact(one, here), second = contact(other, there);
            expect_same(lanes[0], first, "first"), expect_same(lanes[1], second, "second");
            EXPECT_TRUE(first[0] != 0 || second[0] != 0) << "one car must touch the road";
        }
    }
}

TEST(AnyNumber, CarriesEveryForceAlongALineAndTheBrake) {
    expect_same_on_any_number([]<class T>(const Suspension<T>& suspension, const std::array<T, 12>& x) {
        const SuspensionWheel<T>& wheel = suspension.wheels[0];
        const auto brake = wheel.brake.evaluate(max(x[0], T(0)), T(20) * x[1], T(0.1) * x[2]);
        Answers<T> answers;
        for (const T& number : {suspension.springs[0].spring.force(T(T(0.5) + T(0.1) * x[3])),
                                suspension.dampers[0].damper.force(T(T(2) * x[4])), wheel.bump.force(T(T(0.2) * x[5])),
                                wheel.rebound.force(T(T(0.2) * x[6])), brake.torque, brake.windup_rate}) {
            answers.add(number);
        }
        return answers;
    });
}

}  // namespace
}  // namespace hamilcar
