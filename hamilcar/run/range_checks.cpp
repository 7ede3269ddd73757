#include "hamilcar/run/range_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hamilcar/analysis/dimensions.hpp"
#include "hamilcar/base/units.hpp"
#include "hamilcar/road/road_area.hpp"
#include "hamilcar/run/unit_pose_of.hpp"

namespace hamilcar {

namespace {

using units::degree, units::rpm;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
constexpr double unlimited = std::numeric_limits<double>::infinity();

// One tire: of which suspension and wheel, and whether it is the first or the second of it.
struct TirePlace {
    std::string name;
    std::size_t suspension, wheel, number;

    const TireForces<double>& forces(const Sample& s) const {
        return s.momenta.suspensions[suspension].wheels[wheel].tires[number];
    }
    const Tire<double>& tire(const Sample& s) const {
        return s.model.vehicle.suspensions[suspension].wheels[wheel].tire;
    }
};

using Checks = std::vector<RangeCheck>;

// Share of the friction that the deflected contact of a linear tire asks for; sliding asks for more than all.
double linear_demand(const TirePlace& place, const Sample& s) {
    const auto* tire = std::get_if<LinearTire<double>>(&place.tire(s));
    const TireForces<double>& f = place.forces(s);
    if (!tire || !(f.tire.Fz > 0)) return nothing;
    const double x = f.tire.Fz * tire->load_scale;
    const double along = tire->slip_stiffness * f.contact.u * tire->curvature_x;
    const double across = tire->cornering_at_zero / (1 + x * x) * f.contact.v * tire->curvature_y;
    return std::hypot(along, across) / (tire->friction * f.contact.friction);
}

void add_checks(const LinearTireDescription&, const TirePlace& place, Checks& to) {
    to.push_back({.kind = "linear_tire",
                  .where = place.name,
                  .quantity = "share of the friction in use",
                  .unit = "1",
                  .min = 0,
                  .max = linear_share,
                  .meaning = "the linear tire is linear up to the friction limit, a real one up to about half of it; "
                             "beyond, slips are too small and forces too large",
                  .advice = "take a tire with curves (magic_formula, tmeasy) for a maneuver near the limit",
                  .read = [place](const Sample& s) { return linear_demand(place, s); }});
}

// What a tire's file was measured with; forces are those of the nearest end.
struct FileRange {
    const char *kind, *quantity, *unit;
    std::array<double, 2> limits;
    double (*read)(const TireForces<double>&);
};

void add_file_range(const FileRange& range, const TirePlace& place, Checks& to) {
    to.push_back({.kind = range.kind,
                  .where = place.name,
                  .quantity = range.quantity,
                  .unit = range.unit,
                  .min = range.limits[0],
                  .max = range.limits[1],
                  .meaning = "the tire's file ends there; its forces stay those of the end",
                  .advice = "take a tire that was measured farther, or drive less hard",
                  .read = [place, read = range.read](const Sample& s) { return read(place.forces(s)); }});
}

bool rolls(const TireForces<double>& f) {
    return f.tire.Fz > 0 && std::abs(f.contact.v_x) > min_slip_speed;
}

std::array<double, 2> scaled(const std::array<double, 2>& limits, double unit) {
    return {limits[0] / unit, limits[1] / unit};
}

using F = TireForces<double>;

void add_load(double max, const TirePlace& place, Checks& to) {
    add_file_range({"tire_load", "vertical force", "N", {-unlimited, max}, [](const F& f) { return f.tire.Fz; }}, place,
                   to);
}

void add_checks(const MagicFormulaDescription& d, const TirePlace& place, Checks& to) {
    add_load(d.load[1], place, to);
    add_file_range({"tire_slip", "longitudinal slip", "1", d.slip,
                    [](const F& f) { return rolls(f) ? -f.contact.v_sx / std::abs(f.contact.v_x) : nothing; }},
                   place, to);
    add_file_range(
        {"tire_slip_angle", "slip angle", "deg", scaled(d.angle, degree),
         [](const F& f) { return rolls(f) ? std::atan2(f.contact.v_sy, std::abs(f.contact.v_x)) / degree : nothing; }},
        place, to);
    add_file_range({"tire_inclination", "inclination", "deg", scaled(d.camber, degree),
                    [](const F& f) {
                        return f.tire.Fz > 0 ? std::asin(std::clamp(f.contact.camber, -1.0, 1.0)) / degree : nothing;
                    }},
                   place, to);
}

// Measured at the nominal load and at twice that.
void add_checks(const TmeasyDescription& d, const TirePlace& place, Checks& to) {
    add_load(2 * d.nominal_load, place, to);
}

// No range belongs to these.
void add_checks(const SpringTireDescription&, const TirePlace&, Checks&) {}
void add_checks(const FialaDescription&, const TirePlace&, Checks&) {}
void add_checks(const BrushDescription&, const TirePlace&, Checks&) {}
void add_checks(const DugoffDescription&, const TirePlace&, Checks&) {}

// A damper by a curve, whose last pieces are continued.
void add_damper(const SuspensionDescription& suspension, std::size_t at, std::size_t i, Checks& to) {
    const SuspensionDamperDescription& damper = suspension.dampers[i];
    const std::vector<double>& velocity = damper.damper.velocity;
    constexpr std::size_t straight = 2;  // points of a damper that has one coefficient and no end
    if (velocity.size() <= straight) return;
    to.push_back({.kind = "damper_velocity",
                  .where = damper.name + ".damper",
                  .quantity = "velocity",
                  .unit = "m/s",  // one that turns has a coefficient alone
                  .min = velocity.front(),
                  .max = velocity.back(),
                  .meaning = "the damper's curve ends there; its last piece is continued",
                  .advice = "give the curve a point beyond",
                  .read = [at, i](const Sample& s) { return s.momenta.suspensions[at].dampers[i].rate; }});
}

void add_engine(const PowerUnitDescription& unit, std::size_t i, Checks& to) {
    const auto* engine = std::get_if<EngineDescription>(&unit.source);
    if (!engine) return;  // the torque of a motor fades out at its top speed
    double top = 0;
    for (const TorqueCurve& curve : engine->torque) top = std::max(top, curve.speed.back());
    to.push_back({.kind = "engine_speed",
                  .where = unit.name,
                  .quantity = "speed",
                  .unit = "rpm",
                  .min = -unlimited,
                  .max = top / rpm,
                  .meaning = "the engine's torque curve ends there; its torque stays that of the end",
                  .advice = "shift up earlier, or give the curve a point beyond",
                  .read = [i](const Sample& s) {
                      return s.model.vehicle.powertrain.exists() ? s.momenta.powertrain.units[i].spin / rpm : nothing;
                  }});
}

struct WheelPlace {
    std::size_t suspension, wheel;
};

double load_of(const WheelPlace& place, const Sample& s) {
    const WheelForces<double>& wheel = s.momenta.suspensions[place.suspension].wheels[place.wheel];
    const int tires = s.model.vehicle.suspensions[place.suspension].wheels[place.wheel].tires;
    double sum = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(tires); ++k) sum += wheel.tires[k].tire.Fz;
    return sum;
}

// Wheels that must not all be off the ground for long.
void add_lift(std::string where, std::vector<WheelPlace> wheels, Checks& to) {
    to.push_back({.kind = "wheel_lift",
                  .where = std::move(where),
                  .quantity = "load",
                  .unit = "N",
                  .min = 1,
                  .max = unlimited,
                  .patience = lift_patience,
                  .meaning = "all its wheels are off the ground; the vehicle is about to tip over or flies",
                  .advice = "take what comes after it as the way to a fall, not as driving",
                  .read = [wheels = std::move(wheels)](const Sample& s) {
                      double sum = 0;
                      for (const WheelPlace& wheel : wheels) sum += load_of(wheel, s);
                      return sum;
                  }});
}

std::string unit_name(const VehicleDescription& vehicle, std::size_t unit) {
    return unit == 0 ? "vehicle" : vehicle.trailers[unit - 1].name;
}

void add_lifts(const VehicleDescription& vehicle, Checks& to) {
    for (std::size_t unit = 0; unit <= vehicle.trailers.size(); ++unit) {
        std::vector<WheelPlace> left, right;
        for (std::size_t s = 0; s < vehicle.suspensions.size(); ++s) {
            if (vehicle.suspensions[s].unit != unit) continue;
            for (std::size_t w = 0; w < vehicle.suspensions[s].wheels.size(); ++w) {
                const SuspensionWheelDescription& wheel = vehicle.suspensions[s].wheels[w];
                if (std::holds_alternative<SpringTireDescription>(wheel.tire))
                    return;  // it pulls: no wheel of it lifts
                const double y = wheel.wheel.center[1];
                if (y != 0) (y > 0 ? left : right).push_back({s, w});
            }
        }
        if (!left.empty()) add_lift("left side of " + unit_name(vehicle, unit), left, to);
        if (!right.empty()) add_lift("right side of " + unit_name(vehicle, unit), right, to);
    }
    for (const Axle& axle : axles(vehicle)) {
        std::vector<WheelPlace> wheels;
        for (std::size_t s = 0; s < vehicle.suspensions.size(); ++s) {
            for (std::size_t w = 0; w < vehicle.suspensions[s].wheels.size(); ++w) {
                const bool is_on = std::ranges::count(axle.wheels, vehicle.suspensions[s].wheels[w].name) > 0;
                if (is_on) wheels.push_back({s, w});
            }
        }
        add_lift(axle.name, std::move(wheels), to);
    }
}

void add_inclinations(const VehicleDescription& vehicle, Checks& to) {
    for (std::size_t unit = 0; unit <= vehicle.trailers.size(); ++unit) {
        to.push_back({.kind = "vehicle_inclination",
                      .where = unit_name(vehicle, unit),
                      .quantity = "inclination against the road",
                      .unit = "deg",
                      .min = 0,
                      .max = max_inclination,
                      .meaning = "a wheel touches the road as a disc and the body at a few points: no vehicle falls "
                                 "or lies like that",
                      .advice = "take the motion up to there alone",
                      .read = [unit](const Sample& s) {
                          const double up = unit_pose_of(s, unit).R.col(2).dot(s.model.road.normal);
                          return std::acos(std::clamp(up, -1.0, 1.0)) / degree;
                      }});
    }
}

void add_road_edge(const std::shared_ptr<const RoadArea>& area, const TirePlace& place, std::size_t unit, Checks& to) {
    to.push_back({.kind = "road_edge",
                  .where = place.name,
                  .quantity = "distance from the measured road",
                  .unit = "m",
                  .min = 0,
                  .max = road_margin,
                  .meaning = "the road's file ends there; its heights are made up beyond",
                  .advice = "keep to the road, or take a wider or longer file",
                  .read = [area, place, unit](const Sample& s) {
                      const F& f = place.forces(s);
                      if (!(f.tire.Fz > 0)) return nothing;
                      const UnitPose<double> pose = unit_pose_of(s, unit);
                      const Vec3<double> at = pose.position + pose.R * f.frame.point;
                      return area->outside(at[0], at[1]);
                  }});
}

}  // namespace

Checks range_checks(const VehicleDescription& vehicle, const ScenarioDescription& scenario) {
    Checks checks;
    const auto area = std::make_shared<const RoadArea>(scenario.road);
    for (std::size_t s = 0; s < vehicle.suspensions.size(); ++s) {
        const SuspensionDescription& suspension = vehicle.suspensions[s];
        for (std::size_t w = 0; w < suspension.wheels.size(); ++w) {
            const SuspensionWheelDescription& wheel = suspension.wheels[w];
            const bool dual = wheel.dual_spacing > 0;
            for (std::size_t k = 0; k < static_cast<std::size_t>(wheel.tires()); ++k) {
                const std::string name = !dual ? ".tire" : k == 0 ? ".left_tire" : ".right_tire";
                const TirePlace place{wheel.name + name, s, w, k};
                std::visit([&](const auto& tire) { add_checks(tire, place, checks); }, wheel.tire);
                if (area->is_limited()) add_road_edge(area, place, suspension.unit, checks);
            }
        }
        for (std::size_t i = 0; i < suspension.dampers.size(); ++i) add_damper(suspension, s, i, checks);
    }
    for (std::size_t i = 0; i < vehicle.power_units.size(); ++i) add_engine(vehicle.power_units[i], i, checks);
    add_lifts(vehicle, checks);
    add_inclinations(vehicle, checks);
    return checks;
}

}  // namespace hamilcar
