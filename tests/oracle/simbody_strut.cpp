// The arms and tie rods of all struts as the equations of one constraint: Simbody goes through all constraints for every
// multiplier, and that costs more than the equations themselves.

#include "tests/oracle/simbody_parts.hpp"

namespace hamilcar::oracle {

using SimTK::ConstrainedBodyIndex;
using SimTK::SpatialVec;
using SimTK::State;
using SimTK::Transform;
using SimTK::UnitVec3;
using SimTK::Vec3;

namespace {

template <class T>
using PerBody = SimTK::Array_<T, ConstrainedBodyIndex>;
using Coordinates = SimTK::Array_<double, SimTK::ConstrainedQIndex>;
using Equations = SimTK::Array_<double>;

// One equation, in chassis axes: a point of the spindle at a distance from one of the chassis, or on the plane through it.
struct Link {
    ConstrainedBodyIndex spindle;
    Vec3 tip, foot, drive;          // the rack moves the foot by `drive` times its displacement
    std::optional<UnitVec3> plane;  // its normal
    double length = 0;

    // Of the last realized position; there is one state only.
    mutable Vec3 arm{0};                     // of the tip, from the spindle's origin
    mutable SpatialVec on_spindle{Vec3(0)};  // load of a unit multiplier: moment, direction
    mutable SpatialVec on_chassis{Vec3(0)};

    Vec3 span(const Transform& pose, double rack) const { return pose * tip - foot - rack * drive; }
    // Of a length (r^2 - l^2) / 2l: near zero its error, without a root.
    double error(const Vec3& r) const { return plane ? ~*plane * r : (r.normSqr() - length * length) / (2 * length); }
    double bend(const Vec3& r_rate) const { return plane ? 0 : r_rate.normSqr() / length; }

    void realize(const Transform& pose, double rack) const {
        const Vec3 direction = plane ? Vec3(*plane) : Vec3(span(pose, rack) / length);
        arm = pose.R() * tip;
        on_spindle = SpatialVec(arm % direction, direction);
        on_chassis = -SpatialVec((pose.p() + arm) % direction, direction);
    }
};

// The chassis is the common ancestor of the bodies here, so Simbody gives their poses and motions relative to it.
class ArmsAndTieRods : public SimTK::Constraint::Custom::Implementation {
public:
    explicit ArmsAndTieRods(Parts& parts)
        : Implementation(parts.chassis.updMatterSubsystem()),
          inputs_(parts.inputs),
          chassis_(addConstrainedBody(parts.chassis)) {
        for (std::size_t i = 0; i < parts.suspensions.size(); ++i) {
            const SuspensionDescription& strut = parts.description.suspensions[i];
            if (!is_strut(strut)) continue;
            const Placed& spindle = parts.bodies[parts.wheels[parts.suspensions[i].first_wheel].carrier];
            const ConstrainedBodyIndex index = addConstrainedBody(spindle.body);
            for (const CutJointDescription& cut : strut.linkage.cuts) add(cut, index, spindle);
        }
        setDefaultNumConstraintEquations(static_cast<int>(links_.size()), 0, 0);
    }

    Implementation* clone() const override { return new ArmsAndTieRods(*this); }

    void realizePosition(const State& state) const override {
        for (const Link& link : links_) link.realize(getBodyTransformFromState(state, link.spindle), inputs_.rack);
    }

    void calcPositionErrors(const State&, const PerBody<Transform>& poses, const Coordinates&,
                            Equations& errors) const override {
        auto error = errors.begin();
        for (const Link& link : links_) *error++ = link.error(link.span(poses[link.spindle], inputs_.rack));
    }

    void calcPositionDotErrors(const State&, const PerBody<SpatialVec>& velocities, const Coordinates&,
                               Equations& rates) const override {
        auto rate = rates.begin();
        for (const Link& link : links_) {
            const Vec3 driven = inputs_.rack_rate * link.drive;
            *rate++ = ~link.on_spindle * velocities[link.spindle] - ~link.on_spindle[1] * driven;
        }
    }

    void calcPositionDotDotErrors(const State& state, const PerBody<SpatialVec>& accelerations, const Coordinates&,
                                  Equations& rates) const override {
        auto rate = rates.begin();
        for (const Link& link : links_) {
            const SpatialVec& velocity = getBodyVelocityFromState(state, link.spindle);
            const Vec3 turning = velocity[0] % link.arm;
            const Vec3 beyond = velocity[0] % turning - inputs_.rack_acceleration * link.drive;
            *rate++ = ~link.on_spindle * accelerations[link.spindle] + ~link.on_spindle[1] * beyond +
                      link.bend(velocity[1] + turning - inputs_.rack_rate * link.drive);
        }
    }

    // The rack's force ends in the chassis as well.
    void addInPositionConstraintForces(const State&, const Equations& multipliers, PerBody<SpatialVec>& loads,
                                       Coordinates&) const override {
        auto multiplier = multipliers.begin();
        for (const Link& link : links_) {
            loads[link.spindle] += *multiplier * link.on_spindle;
            loads[chassis_] += *multiplier++ * link.on_chassis;
        }
    }

private:
    // An arm is a plane across its axis and a distance in it.
    void add(const CutJointDescription& cut, ConstrainedBodyIndex index, const Placed& spindle) {
        Link link{index, spindle.station(cut.tip), to_vec3(cut.foot), to_vec3(cut.drive)};
        if (cut.kind == CutJoint::revolute_spherical) {
            link.plane = UnitVec3(to_vec3(cut.axis));
            link.foot += link.error(to_vec3(cut.tip) - link.foot) * *link.plane;
            links_.push_back(link);
            link.plane.reset();
        }
        link.length = cut.length.value_or((to_vec3(cut.tip) - link.foot).norm());
        links_.push_back(link);
    }

    const Inputs& inputs_;
    ConstrainedBodyIndex chassis_;
    std::vector<Link> links_;
};

}  // namespace

void add_arms_and_tie_rods(Parts& parts) {
    SimTK::Constraint::Custom(new ArmsAndTieRods(parts));
}

}  // namespace hamilcar::oracle
