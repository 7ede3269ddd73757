// Axles whose two wheels are one suspension: solid axles on links, with a Watt linkage, on leaf springs; the twist beam.
//
// A solid axle is free in space and loses four of its six freedoms; heave and roll remain, and they are the independent
// coordinates whatever the links are: no link of a solid axle is vertical, so over the whole travel none of them locks.
#include "hamilcar/suspension/recipe.hpp"

namespace hamilcar {

namespace {

constexpr auto point = HardpointKind::point;

Point middle(const Point& p) {
    return {p[0], 0, p[2]};
}

// A link on the left and one on the right.
void add_pair(Composition& to, const Hardpoints& p, const std::string& name, std::string_view tip,
              std::string_view foot) {
    constexpr std::size_t axle = 1;
    to.cut(CutJoint::distance, "left " + name, axle, p[tip], 0, p[foot]);
    to.cut(CutJoint::distance, "right " + name, axle, p.right(tip), 0, p.right(foot));
}

// Knuckles on kingpins, tied together; a drag link from the steering gear moves the left one.
void add_steering(Composition& to, const Hardpoints& p, std::size_t axle) {
    const std::size_t left = to.hinge("left knuckle", axle, p["kingpin_lower_m"], p["kingpin_upper_m"]);
    const std::size_t right = to.hinge("right knuckle", axle, p.right("kingpin_lower_m"), p.right("kingpin_upper_m"));
    to.cut(CutJoint::distance, "tie rod", left, p["tie_rod_m"], right, p.right("tie_rod_m"));
    to.cut(CutJoint::distance, "drag link", left, p["drag_link_knuckle_m"], 0, p["drag_link_body_m"]).drive =
        p["rack_axis"];
    to.parts = {{"carrier", left, right, true, true}, {"beam", axle, axle, true, true}, {"axle", axle, axle}};
    to.carriers = {left, right};
    to.adjusters = {{WheelAngle::toe, "tie rod"}, {WheelAngle::toe, "drag link"}};
}

// An axle that is free in space, about `center`.
Composition free_axle(const Point& center) {
    Composition out;
    const std::size_t axle = out.join(TreeJoint::free, "axle", 0, middle(center));
    out.linkage.independent = {2, 4};  // heave, roll
    out.parts = {{"carrier", axle, axle, true, true}, {"axle", axle, axle}};
    out.carriers = {axle, axle};
    out.drive_reaction = axle;  // the differential sits in it
    return out;
}

Composition& steer_if_requested(Composition& axle, const Hardpoints& p) {
    if (p.flag("steered")) add_steering(axle, p, 1);
    return axle;
}

Composition four_link(const Hardpoints& p) {
    Composition out = free_axle(p["lower_axle_m"]);
    add_pair(out, p, "lower link", "lower_axle_m", "lower_body_m");
    add_pair(out, p, "upper link", "upper_axle_m", "upper_body_m");
    return steer_if_requested(out, p);
}

Composition three_links(const Hardpoints& p) {
    Composition out = free_axle(p["lower_axle_m"]);
    add_pair(out, p, "lower link", "lower_axle_m", "lower_body_m");
    out.cut(CutJoint::distance, "upper link", 1, p["upper_axle_m"], 0, p["upper_body_m"]);
    return out;
}

Composition panhard(const Hardpoints& p) {
    Composition out = three_links(p);
    out.cut(CutJoint::distance, "Panhard rod", 1, p["panhard_axle_m"], 0, p["panhard_body_m"]);
    return steer_if_requested(out, p);
}

// The bell crank turns on the axle; two rods hold it to the chassis.
Composition watt(const Hardpoints& p) {
    Composition out = three_links(p);
    const std::size_t crank = out.join(TreeJoint::revolute, "bell crank", 1, p["watt_pivot_m"], p["watt_axis"]);
    out.cut(CutJoint::distance, "left Watt rod", crank, p["watt_left_crank_m"], 0, p["watt_left_body_m"]);
    out.cut(CutJoint::distance, "right Watt rod", crank, p["watt_right_crank_m"], 0, p["watt_right_body_m"]);
    return steer_if_requested(out, p);
}

// Links equivalent to the leaves (SAE HS-788): as a leaf bends, its seat moves on an arc about a point between eye and seat,
// and keeps its inclination. A central link parallel to those of the leaves takes the wind-up; sideways the leaves are stiff.
Composition leaf(const Hardpoints& p) {
    const auto pivot_of = [&](const Point& eye, const Point& seat) {
        Point pivot;
        for (std::size_t i = 0; i < 3; ++i) pivot[i] = seat[i] + p.number("link_share") * (eye[i] - seat[i]);
        return pivot;
    };
    const Point seat = p["seat_m"], right_seat = p.right("seat_m");
    const Point pivot = pivot_of(p["front_eye_m"], seat), right_pivot = pivot_of(p.right("front_eye_m"), right_seat);
    Composition out = free_axle(seat);
    out.links_are_equivalent = true;
    out.cut(CutJoint::distance, "left leaf", 1, seat, 0, pivot);
    out.cut(CutJoint::distance, "right leaf", 1, right_seat, 0, right_pivot);
    constexpr double raised = 0.15;  // of the central link [m]; a parallel link steers the same wherever it is
    Point tip = middle(seat), foot = middle(pivot);
    tip[2] += raised, foot[2] += raised;
    out.cut(CutJoint::distance, "leaves' wind-up", 1, tip, 0, foot);
    out.cut(CutJoint::plane, "leaves' side", 1, middle(seat), 0, middle(seat)).axis = {0, 1, 0};
    return steer_if_requested(out, p);
}

// Two trailing arms that twist against each other about the beam's shear center line. Each bush slides along the line of
// both, the middle of the beam stays in the middle plane: symmetric, and free in heave and twist.
Composition twist_beam(const Hardpoints& p) {
    Composition out;
    const Point bush = p["bush_m"], right_bush = p.right("bush_m"), beam = middle(p["beam_m"]), lateral{0, 1, 0};
    const std::size_t left = out.join(TreeJoint::free, "left arm", 0, beam);
    const std::size_t right = out.join(TreeJoint::revolute, "right arm", left, beam, lateral);
    out.cut(CutJoint::line, "left bush", left, bush, 0, bush).axis = lateral;
    out.cut(CutJoint::line, "right bush", right, right_bush, 0, right_bush).axis = lateral;
    out.cut(CutJoint::plane, "bushes' side", left, beam, 0, beam).axis = lateral;
    out.linkage.independent = {5, 6};  // the left arm's angle, the twist
    out.twist = 6;
    out.parts = {{"carrier", left, right, true, true}};
    out.carriers = {left, right};
    return out;
}

// Appends the keys that a steered solid axle needs.
std::vector<HardpointKey> with_steering(std::vector<HardpointKey> keys) {
    const std::vector<HardpointKey> steering{
        one_for_both({"steered", HardpointKind::flag, "whether the wheels turn on kingpins", {0}}),
        {"kingpin_lower_m", point, "left kingpin, lower end", {}, true},
        {"kingpin_upper_m", point, "left kingpin, upper end", {}, true},
        {"tie_rod_m", point, "tie rod, end on the left knuckle; the other is its mirror image", {}, true},
        one_for_both({"drag_link_body_m", point, "drag link, end at the steering gear", {}, true}),
        one_for_both({"drag_link_knuckle_m", point, "drag link, end on the left knuckle", {}, true}),
        one_for_both(
            {"rack_axis", HardpointKind::direction, "in which a positive rack moves the drag link's end", {0, 1, 0}})};
    keys.insert(keys.end(), steering.begin(), steering.end());
    return keys;
}

// And the points there, of a front axle, the drag link beside a Panhard rod.
std::map<std::string_view, Point> with_steering_points(std::map<std::string_view, Point> points) {
    points.insert({{"kingpin_lower_m", {0.005, 0.673, 0.212}},
                   {"kingpin_upper_m", {-0.005, 0.646, 0.386}},
                   {"tie_rod_m", {-0.134, 0.626, 0.275}},
                   {"drag_link_body_m", {0.142, -0.434, 0.39}},
                   {"drag_link_knuckle_m", {0.134, 0.626, 0.345}},
                   {"rack_axis", {0, 1, 0}}});
    return points;
}

const HardpointKey lower_body{"lower_body_m", point, "left lower link, end on the chassis"};
const HardpointKey lower_axle{"lower_axle_m", point, "left lower link, end on the axle"};
const HardpointKey upper_body = one_for_both({"upper_body_m", point, "upper link, end on the chassis"});
const HardpointKey upper_axle = one_for_both({"upper_axle_m", point, "upper link, end on the axle"});

}  // namespace

const Recipe four_link_axle_recipe{
    .keyword = "four_link_axle",
    .title = "Solid axle on four links",
    .two_wheels = true,
    .keys = with_steering({lower_body,
                           lower_axle,
                           {"upper_body_m", point, "left upper link, end on the chassis"},
                           {"upper_axle_m", point, "left upper link, end on the axle"}}),
    .spring_part = "axle",
    .compose = four_link,
    .typical = {.points = with_steering_points({{"lower_body_m", {0.663, 0.454, 0.291}},
                                                {"lower_axle_m", {0.035, 0.474, 0.267}},
                                                {"upper_body_m", {0.427, 0.384, 0.495}},
                                                {"upper_axle_m", {0.019, 0.05, 0.448}}}),
                .spring = {{{-0.005, 0.474, 0.354}, {-0.005, 0.474, 0.605}}},
                .damper = {{{-0.075, 0.505, 0.299}, {0.035, 0.434, 0.66}}}}};

const Recipe panhard_axle_recipe{
    .keyword = "panhard_axle",
    .title = "Solid axle on three links with Panhard rod",
    .two_wheels = true,
    .keys = with_steering({lower_body, lower_axle, upper_body, upper_axle,
                           one_for_both({"panhard_body_m", point, "Panhard rod, end on the chassis"}),
                           one_for_both({"panhard_axle_m", point, "Panhard rod, end on the axle"})}),
    .spring_part = "axle",
    .compose = panhard,
    .typical = {.points = with_steering_points({{"lower_body_m", {0.669, 0.404, 0.315}},
                                                {"lower_axle_m", {0.031, 0.434, 0.275}},
                                                {"upper_body_m", {0.59, 0, 0.441}},
                                                {"upper_axle_m", {0.016, 0, 0.401}},
                                                {"panhard_body_m", {-0.087, -0.485, 0.393}},
                                                {"panhard_axle_m", {-0.087, 0.464, 0.354}}}),
                .spring = {{{0, 0.434, 0.346}, {0, 0.434, 0.598}}},
                .damper = {{{0, 0.434, 0.331}, {0, 0.434, 0.677}}}}};

const Recipe watt_axle_recipe{
    .keyword = "watt_axle",
    .title = "Solid axle on three links with Watt linkage",
    .two_wheels = true,
    .keys = with_steering({lower_body, lower_axle, upper_body, upper_axle,
                           one_for_both({"watt_pivot_m", point, "pivot of the bell crank on the axle"}),
                           one_for_both({"watt_axis", HardpointKind::direction, "axis of the bell crank", {1, 0, 0}}),
                           one_for_both({"watt_left_crank_m", point, "left rod, end on the bell crank"}),
                           one_for_both({"watt_left_body_m", point, "left rod, end on the chassis"}),
                           one_for_both({"watt_right_crank_m", point, "right rod, end on the bell crank"}),
                           one_for_both({"watt_right_body_m", point, "right rod, end on the chassis"})}),
    .spring_part = "axle",
    .compose = watt,
    .typical = {.points = with_steering_points({{"lower_body_m", {0.589, 0.458, 0.332}},
                                                {"lower_axle_m", {0.054, 0.479, 0.246}},
                                                {"upper_body_m", {0.375, 0, 0.504}},
                                                {"upper_axle_m", {0.032, 0, 0.461}},
                                                {"watt_pivot_m", {-0.15, 0, 0.3}},
                                                {"watt_left_crank_m", {-0.15, 0, 0.386}},
                                                {"watt_left_body_m", {-0.15, 0.5, 0.386}},
                                                {"watt_right_crank_m", {-0.15, 0, 0.214}},
                                                {"watt_right_body_m", {-0.15, -0.5, 0.214}}}),
                .spring = {{{0, 0.521, 0.354}, {0, 0.521, 0.632}}},
                .damper = {{{-0.086, 0.542, 0.246}, {-0.043, 0.479, 0.675}}}}};

const Recipe leaf_axle_recipe{
    .keyword = "leaf_axle",
    .title = "Solid axle on leaf springs",
    .two_wheels = true,
    .keys = with_steering(
        {{"front_eye_m", point, "left leaf, fixed eye"},
         {"seat_m", point, "left leaf, seat on the axle"},
         one_for_both({"link_share", HardpointKind::number, "equivalent link over eye to seat", {0.75}})}),
    .spring_part = "axle",
    .compose = leaf,
    .typical = {.points = with_steering_points({{"front_eye_m", {0.57, 0.502, 0.335}}, {"seat_m", {0, 0.502, 0.359}}}),
                .spring = {{{0, 0.502, 0.359}, {0, 0.502, 0.604}}},
                .damper = {{{-0.059, 0.441, 0.237}, {-0.116, 0.37, 0.596}}}}};

const Recipe twist_beam_recipe{
    .keyword = "twist_beam",
    .title = "Twist beam",
    .two_wheels = true,
    .keys = {{"bush_m", point, "left bush on the chassis"},
             one_for_both({"beam_m", point, "a point of the beam's shear center line; its middle is taken"})},
    .spring_part = "carrier",
    .compose = twist_beam,
    .typical = {.points = {{"bush_m", {0.415, 0.553, 0.325}}, {"beam_m", {0.276, 0, 0.324}}},
                .spring = {{{0.03, 0.469, 0.27}, {0.044, 0.469, 0.497}}},
                .damper = {{{-0.079, 0.543, 0.27}, {-0.044, 0.528, 0.695}}}}};

}  // namespace hamilcar
