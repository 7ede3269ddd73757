// Every model of the lists on the number that records: what a double gives, the recorded program gives bit for bit, in a lane
// beside a lane of another car in another situation. A model that takes a branch on a number, or looks into a table by one,
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

using Recorded = Traced<double>;

// Two cars of one topology and with nothing else in common, for the two lanes.
struct Cars {
    VehicleDescription one, other;
};

VehicleDescription stretched(VehicleDescription car) {
    car.chassis.mass *= 1.1;
    for (CornerDescription& corner : car.corners) {
        corner.wheel.center[1] *= 1.02;
        corner.spring.rate *= 1.3;
        corner.brake.max_torque *= 0.8;
        if (corner.damper.force.size() > 1) corner.damper.force.back() *= 2;
        if (auto* strut = std::get_if<MacPhersonDescription>(&corner.suspension)) strut->ball_joint[2] += 0.01;
        if (auto* arm = std::get_if<SemiTrailingArmDescription>(&corner.suspension)) arm->outer_bush[2] += 0.01;
        test::stretch(corner.tire, 1.05);
    }
    return car;
}

std::vector<Cars> cars() {
    const VehicleDescription shipped = test::paper_car(), conservative = test::conservative_car();
    VehicleDescription mixed = shipped;  // a tire of another model at each corner
    for (std::size_t i = 0; i < mixed.corners.size(); ++i) mixed.corners[i].tire = test::slip_tires()[i];
    return {{shipped, stretched(shipped)}, {conservative, stretched(conservative)}, {mixed, stretched(mixed)}};
}

// What a model answered, number by number.
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

// `ask(spoke, situation)` answers for a Spoke of any number; each spoke of each car is asked in pairs of situations.
template <class Ask>
void expect_same_on_any_number(const Ask& ask) {
    std::mt19937 source(5);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (const Cars& cars_abreast : cars()) {
        const Vehicle<double> one(cars_abreast.one), other(cars_abreast.other);
        for (std::size_t i = 0; i < one.spokes.size(); ++i) {
            const auto ask_spoke = [&]<class T>(const Vehicle<T>& vehicle, const T* situation) {
                std::array<T, 12> x;
                std::copy_n(situation, x.size(), x.begin());
                return ask(vehicle.spokes[i], x).numbers;
            };
            const RecordedPair pair(one, other, 12, ask_spoke);
            for (int trial = 0; trial < 50; ++trial) {
                std::vector<double> here(12), there(12);
                for (std::size_t k = 0; k < here.size(); ++k) here[k] = unit(source), there[k] = unit(source);
                const auto lanes = pair.run(here, there);
                expect_same(lanes[0], ask_spoke(one, here.data()), "spoke " + std::to_string(i));
                expect_same(lanes[1], ask_spoke(other, there.data()), "spoke " + std::to_string(i));
            }
        }
    }
}

TEST(AnyNumber, CarriesEverySuspension) {
    std::set<std::size_t> met;
    expect_same_on_any_number([&]<class T>(const Spoke<T>& spoke, const std::array<T, 12>& x) {
        met.insert(spoke.suspension.index());
        return dispatch(spoke.suspension, [&](const auto& suspension) {
            using Linkage = typename std::decay_t<decltype(suspension)>::Linkage;
            std::array<T, Linkage::nV> V;
            std::array<T, std::max(Linkage::nW, 1)> W;
            Vector<T, Linkage::nV> V_rate;
            for (std::size_t j = 0; j < V.size(); ++j) {
                V[j] = T(0.4) + T(0.05) * x[j], V_rate[static_cast<int>(j)] = x[3 + j];
            }
            for (std::size_t j = 0; j < W.size(); ++j) W[j] = T(2) * x[6 + j];  // far enough for every quadrant
            const RackMotion<T> rack{T(0.01) * x[9], x[10], x[11]};
            const auto at = suspension.linkage.position(V.data(), W.data(), rack, T(30));
            const auto rates = suspension.linkage.rates(at, V_rate, rack);
            const auto spring = suspension.spring_line(at, V.data());
            const auto damper = suspension.damper_line(at, V.data());
            Answers<T> answers;
            answers.add(at.J), answers.add(at.pose.R), answers.add(at.pose.p), answers.add(rates.J);
            if constexpr (Linkage::nW > 0) {
                answers.add(at.Phi), answers.add(at.H), answers.add(at.X), answers.add(at.closing);
                answers.add(at.x), answers.add(at.determinant), answers.add(rates.W);
                answers.add(suspension.linkage.drift_rate(at, rates, rack, T(30)));
            }
            answers.add(spring.length), answers.add(damper.rate(V_rate));
            return answers;
        });
    });
    EXPECT_EQ(met.size(), std::variant_size_v<Suspension<double>>) << "no vehicle here has some suspension of the list";
}

TEST(AnyNumber, CarriesEveryTire) {
    std::set<std::size_t> met;
    expect_same_on_any_number([&]<class T>(const Spoke<T>& spoke, const std::array<T, 12>& x) {
        met.insert(spoke.tire.index());
        return dispatch(spoke.tire, [&](const auto& tire) {
            const RoadPlane<T> road{Vec3<T>(T(0.1) * x[0], T(0.1) * x[1], T(1)), T(0.1) * x[2], T(0.9)};
            const Vec3<T> axis(T(0.2) * x[3], T(1), T(0.2) * x[4]);
            const auto frame = contact_frame<T>(road, spoke.wheel.center, axis, tire.radius);
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

// One car on its roof, the other above the road: the lane in the air must not feel that its neighbor is down.
TEST(AnyNumber, CarriesTheHull) {
    const auto contact = []<class T>(const Vehicle<T>& vehicle, const T& height) {
        const RoadPlane<T> road{Vec3<T>(T(0.1), T(0.2), T(-0.97)), -height, T(0.9)};
        const auto found = vehicle.hull.contact(road, Spatial<T>::Constant(T(0.7)));
        Answers<T> answers;
        answers.add(found.wrench), answers.add(found.lost_power);
        return answers.numbers;
    };
    for (const Cars& cars_abreast : cars()) {
        const Vehicle<double> one(cars_abreast.one), other(cars_abreast.other);
        const auto ask = [&]<class T>(const Vehicle<T>& vehicle, const T* height) { return contact(vehicle, *height); };
        const RecordedPair pair(one, other, 1, ask);
        for (const auto& [here, there] : {std::pair(-1.0, 5.0), std::pair(5.0, -1.0), std::pair(-1.0, -2.0)}) {
            const auto lanes = pair.run({here}, {there});
            const auto first = contact(one, here), second = contact(other, there);
            expect_same(lanes[0], first, "first"), expect_same(lanes[1], second, "second");
            EXPECT_TRUE(first[0] != 0 || second[0] != 0) << "somebody must be down";
        }
    }
}

TEST(AnyNumber, CarriesEveryForceAlongALineAndTheBrake) {
    expect_same_on_any_number([]<class T>(const Spoke<T>& spoke, const std::array<T, 12>& x) {
        const auto brake = spoke.brake.evaluate(max(x[0], T(0)), T(20) * x[1], T(0.1) * x[2]);
        Answers<T> answers;
        for (const T& number : {spoke.spring.force(T(T(0.5) + T(0.1) * x[3])), spoke.damper.force(T(T(2) * x[4])),
                                spoke.bump.force(T(T(0.2) * x[5])), spoke.rebound.force(T(T(0.2) * x[6])), brake.torque,
                                brake.windup_rate}) {
            answers.add(number);
        }
        return answers;
    });
}

}  // namespace
}  // namespace hamilcar
