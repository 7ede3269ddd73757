// Uneven ground in a recorded step: a call of the program, which looks a wheel's ground up in each lane.
#pragma once

#include "hamilcar/math/traced.hpp"
#include "hamilcar/road/ground.hpp"

namespace hamilcar {

// What a run gives the calls: the surface of each lane, null where it is none, and the time [s].
struct GroundBelowLanes {
    const Surface* const* surfaces;
    double time;
};

// What a call is told, each a number of its own.
template <class T>
struct GroundQuestion {
    Vec3<T> center, axis;
    Spatial<T> motion;
    T radius, clearance;
    Vec3<T> position;
    Mat3<T> R;
    Vec3<T> base;
    T friction;
    WheelRoad<T> plane;  // the answer where the lane has no surface

    static constexpr int count = 3 + 3 + 6 + 2 + 3 + 9 + 3 + 1 + 6;
    // Calls f with each number; of the same question always in one order.
    template <class Self, class F>
    static void for_each(Self& self, F&& f) {
        const auto all = [&](auto& numbers) {
            for (int i = 0; i < static_cast<int>(numbers.size()); ++i) f(numbers.data()[i]);
        };
        all(self.center), all(self.axis), all(self.motion), f(self.radius), f(self.clearance);
        all(self.position), all(self.R), all(self.base), f(self.friction);
        for_each_answer(self.plane, f);
    }
    static constexpr int answer_count = 6;
    template <class Road, class F>
    static void for_each_answer(Road& road, F&& f) {
        for (int i = 0; i < 3; ++i) f(road.plane.normal[i]);
        f(road.plane.offset), f(road.plane.friction), f(road.rise);
    }
};

// The function of such a call; `wheel` is the wheel's number, `context` a GroundBelowLanes.
template <class E>
void answer_ground_question(const void* context, int wheel, int lanes, const void* arguments, void* results) {
    const auto& below = *static_cast<const GroundBelowLanes*>(context);
    for (int lane = 0; lane < lanes; ++lane) {
        const E* argument = static_cast<const E*>(arguments) + lane;
        const auto next = [&](E& number) { number = *argument, argument += lanes; };
        GroundQuestion<E> q;
        GroundQuestion<E>::for_each(q, next);
        if (below.surfaces[lane]) {
            const UnevenGround<double> uneven(below.surfaces[lane], q.base.template cast<double>(), q.friction,
                                              q.position.template cast<double>(), q.R.template cast<double>(),
                                              below.time);
            fit_ground<E>(uneven, q.center, q.axis, q.motion, q.radius, q.clearance, {wheel, wheel}, q.plane);
        }
        E* result = static_cast<E*>(results) + lane;
        GroundQuestion<E>::for_each_answer(q.plane, [&](const E& number) { *result = number, result += lanes; });
    }
}

// A call for each of the wheels side by side.
template <class E, int width>
void fit_ground(const UnevenGround<Traced<E>>& uneven, const Vec3<Traced<E, width>>& center,
                const Vec3<Traced<E, width>>& axis, const Spatial<Traced<E, width>>& motion,
                const Traced<E, width>& radius, const Traced<E, width>& clearance, const std::array<int, 2>& numbers,
                WheelRoad<Traced<E, width>>& road) {
    using T = Traced<E, width>;
    using Question = GroundQuestion<Traced<E>>;
    WheelRoad<T> answer = road;
    for (int l = 0; l < width; ++l) {
        const auto part = [l](const auto& both) {
            Vector<Traced<E>, std::decay_t<decltype(both)>::SizeAtCompileTime> out;
            for (int i = 0; i < out.size(); ++i) out[i] = lane(both[i], l);
            return out;
        };
        const Question q{
            part(center),
            part(axis),
            part(motion),
            lane(radius, l),
            lane(clearance, l),
            uneven.position,
            uneven.R,
            uneven.base,
            uneven.friction,
            {{part(road.plane.normal), lane(road.plane.offset, l), lane(road.plane.friction, l)}, lane(road.rise, l)}};
        std::vector<program::Id> arguments;
        Question::for_each(q, [&](const Traced<E>& number) { arguments.push_back(number.id()); });
        program::Id result =
            Tracing::graph().call(0, numbers[static_cast<std::size_t>(l)], arguments, Question::answer_count);
        Question::for_each_answer(answer, [&](T& number) { set_lane(number, l, Traced<E>::of(result++)); });
    }
    road = answer;
}

}  // namespace hamilcar
