#include "hamilcar/template/axle_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hamilcar/base/text.hpp"
#include "hamilcar/template/vehicle_template.hpp"

namespace hamilcar {

namespace {

// Shares of the vehicle's mass, of shipped vehicles.
constexpr double corner_share = 0.03;                       // knuckle, bearing, brake, wheel and half of the links
constexpr double axle_share = 0.095;                        // a solid axle with its wheels
constexpr double beam_share = 0.06, knuckle_share = 0.036;  // a steered one's

bool is_solid(const Recipe& recipe) {
    return recipe.two_wheels && recipe.keyword != "twist_beam";
}

// The typical axle at this one's wheels. A solid axle's links lead forward at the rear and rearward in front.
Point placed(const AxleSizes& axle, const Point& typical, bool of_steering = false) {
    const Point& from = TypicalAxle::wheel_center;
    const double scale = axle.wheel[2] / from[2],
                 sign = is_solid(*axle.recipe) && axle.is_front && !of_steering ? -1 : 1;
    return {axle.wheel[0] + sign * scale * typical[0], typical[1] * axle.wheel[1] / from[1], typical[2] * scale};
}

std::string hardpoints_text(const AxleSizes& axle) {
    std::string out =
        "[axle.hardpoints]                             # typical of the suspension, scaled to track and wheel\n";
    for (const HardpointKey& key : axle.recipe->keys) {
        const auto typical = axle.recipe->typical.points.find(key.key);
        const std::string meaning = "[E] " + std::string(key.meaning);
        if (key.kind == HardpointKind::point && (axle.is_front || !key.only_steered)) {
            out += line(std::string(key.key), point(placed(axle, typical->second, key.only_steered)), meaning);
        } else if (key.key == "steered") {
            out += line("steered", axle.is_front ? "true" : "false", "layout");
        } else if (key.key == "rack_axis" && axle.is_front) {
            const Point& axis = typical->second;
            out += line("rack_axis", fmt::format("[{:.1f}, {:.1f}, {:.1f}]", axis[0], axis[1], axis[2]),
                        "layout: this way it steers to the left");
        }
    }
    return out;
}

std::string body_text(const AxleBody& body) {
    const auto inertia = [&](double radius) { return number(body.mass * radius * radius); };
    const auto& [x, y, z] = body.radii;
    return fmt::format("\n[axle.{}]\n", body.table) +
           line("mass_kg", fmt::format("{:.1f}", body.mass), "[E] " + body.what) +
           line("center_of_mass_m", point(body.center), "[E]") +
           line("inertia_kg_m2", fmt::format("[{}, {}, {}]", inertia(x), inertia(y), inertia(z)),
                "[E] without the wheels' spin");
}

std::string ends_text(const AxleSizes& axle, const std::optional<TypicalAxle::Ends>& ends) {
    if (!ends) return "";
    return line("at_m", point(placed(axle, ends->at)), "[E] on the suspension") +
           line("body_m", point(placed(axle, ends->body)), "[E] on the chassis");
}

std::string stop_text(const std::string& table, double gap, double rate, double progression) {
    return fmt::format("\n[axle.{}]\n", table) + line("gap_m", number(gap), "[E] of wheel travel") +
           line("rate_N_per_m", number(rate), "[E]") + line("progression_N_per_m2", number(progression), "[E]");
}

std::string brake_text(const AxleSizes& axle) {
    return "\n[axle.brake]\n" + line("max_torque_N_m", number(axle.brake_torque),
                                     "[E] 1.6 times what 1 g takes, by the axle loads at 1.1 g");
}

}  // namespace

std::string line(const std::string& key, const std::string& value, const std::string& comment) {
    constexpr int comments_at = 46;
    const std::string text = key + " = " + value;
    return comment.empty() ? text + "\n" : fmt::format("{:<{}} # {}\n", text, comments_at - 1, comment);
}

std::string number(double value) {
    if (value == 0) return "0";
    const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - 3);
    return number_text(unit < 1 ? std::round(value / unit) / std::round(1 / unit) : std::round(value / unit) * unit);
}

std::string point(const Point& p) {
    return fmt::format("[{:.4f}, {:.4f}, {:.4f}]", p[0] + 0.0, p[1] + 0.0, p[2] + 0.0);
}

// Radii of inertia are shares of the wheel's radius and of the half track.
std::vector<AxleBody> bodies_of(const AxleSizes& axle) {
    const double r = axle.tire_radius, half = axle.wheel[1];
    const auto mass = [&](double share) { return std::round(10 * share * axle.mass) / 10; };
    const Point at_axle{axle.wheel[0], 0, axle.wheel[2]};
    const Point at_wheel{axle.wheel[0], axle.wheel[1] - 0.15 * r, axle.wheel[2] + 0.06 * r};
    const Point of_wheel{0.47 * r, 0.33 * r, 0.40 * r};
    if (!axle.recipe->two_wheels) {
        return {
            {"carrier", "knuckle, bearing, brake, wheel, half of the links", mass(corner_share), at_wheel, of_wheel}};
    }
    if (!is_solid(*axle.recipe)) {
        return {{"carrier", "trailing arm with its wheel and half of the beam", mass(corner_share),
                 Point{axle.wheel[0] + 0.28 * r, 0.83 * half, axle.wheel[2] + 0.03 * r},
                 Point{0.68 * r, 0.45 * r, 0.75 * r}}};
    }
    if (!axle.is_front) {
        return {{"carrier", "the whole axle with both wheels", mass(axle_share), at_axle,
                 Point{0.76 * half, 0.33 * r, 0.75 * half}}};
    }
    return {
        {"beam", "the axle between its knuckles", mass(beam_share), at_axle, Point{0.52 * half, 0.33 * r, 0.51 * half}},
        {"carrier", "left knuckle with its wheel", mass(knuckle_share), at_wheel, of_wheel}};
}

double unsprung_mass(const AxleSizes& axle) {
    double mass = 0;
    for (const AxleBody& body : bodies_of(axle)) mass += body.copies() * body.mass;
    return mass;
}

bool can_be_steered(const Recipe& recipe) {
    return recipe.typical.points.contains("rack_axis");
}

std::string axle_text(const AxleSizes& axle) {
    const Recipe& recipe = *axle.recipe;
    const double mass = axle.mass, camber = is_solid(recipe) ? 0 : -0.5;
    std::string out = "[[axle]]\n" + line("name", fmt::format("\"{}\"", axle.name())) +
                      line("suspension", fmt::format("\"{}\"", recipe.keyword), std::string(recipe.title)) +
                      line("tire", "\"road\"") +
                      line("drive_share", number(axle.drive_share), "of a torque that a scenario prescribes") + "\n";
    out += hardpoints_text(axle);
    for (const AxleBody& body : bodies_of(axle)) out += body_text(body);
    out += "\n[axle.wheel]\n" + line("center_m", point(axle.wheel), "[E] half of the track; the tire's loaded radius") +
           line("camber_deg", fmt::format("{:.1f}", camber), "[E]") +
           line("toe_in_deg", is_solid(recipe) ? "0.0" : "0.1", "[E] of this wheel") +
           line("spin_inertia_kg_m2", number(axle.spin_inertia), "[E] wheel, tire and disc");
    if (recipe.keyword == "twist_beam") {
        out +=
            "\n[axle.twist_spring]\n" + line("rate_N_m_per_rad", number(0.6 * mass), "[E] of twist between the arms");
    }
    out += "\n[axle.spring]\n" + line("rate_N_per_m", number(axle.spring_rate), "[E] for the ride frequency") +
           line("force_at_design_N", "\"carry\"", "whatever carries the vehicle at design") +
           ends_text(axle, recipe.typical.spring);
    out += "\n[axle.damper]\n" + line("damping_N_s_per_m", number(axle.damping), "[E] 0.3 of critical") +
           ends_text(axle, recipe.typical.damper);
    out += stop_text("bump_stop", 0.2 * axle.tire_radius, 45 * mass, 750 * mass) +
           stop_text("rebound_stop", 0.27 * axle.tire_radius, 75 * mass, 0);
    if (axle.bar_rate > 0) {
        out += "\n[axle.anti_roll_bar]\n" +
               line("rate_N_per_m", number(axle.bar_rate), "[E] of wheel travel difference, for the roll gradient");
    }
    return out + brake_text(axle);
}

}  // namespace hamilcar
