// The MacPherson corners in relative coordinates: the spindle slides on a massless piston rod that turns in the strut
// top, so the slide axis needs no multipliers. Arms and tie rods may be Simbody's constraints or, faster, the equations
// of one for the whole car: Simbody goes through all constraints for every multiplier, and that costs more than the
// equations themselves.

#include "tests/oracle/simbody_parts.hpp"

namespace hamilcar::oracle {

using SimTK::ConstrainedBodyIndex;
using SimTK::MobilizedBody;
using SimTK::Rotation;
using SimTK::SpatialVec;
using SimTK::State;
using SimTK::Transform;
using SimTK::Vec3;

namespace {

template <class T>
using PerBody = SimTK::Array_<T, ConstrainedBodyIndex>;
using Coordinates = SimTK::Array_<double, SimTK::ConstrainedQIndex>;
using Equations = SimTK::Array_<double>;

// Of each corner: the plane that the ball joint moves in, the length of the arm, the length of the tie rod.
constexpr int equations_per_corner = 3;

// A corner's links in chassis axes. The rate of equation k is direction[k] . (velocity of the wheel center)
// + moment[k] . (angular velocity), less what the rack adds.
struct Links {
    Links(const Linkage& linkage, const Transform& spindle, double rack)
        : wheel_center(spindle.p()),
          ball(spindle.R() * (linkage.ball - linkage.wheel_center)),
          tie_rod_end(spindle.R() * (linkage.tie_rod - linkage.wheel_center)),
          arm(wheel_center + ball - linkage.arm_foot),
          tie_rod(wheel_center + tie_rod_end - linkage.rack_end - rack * Vec3(linkage.rack_axis)),
          direction{Vec3(linkage.arm_axis), arm / linkage.arm_length, tie_rod / linkage.tie_rod_length},
          moment{ball % direction[0], ball % direction[1], tie_rod_end % direction[2]} {}

    Vec3 wheel_center;       // from the chassis' origin
    Vec3 ball, tie_rod_end;  // from the wheel center
    Vec3 arm, tie_rod;       // from the chassis' end to the spindle's
    std::array<Vec3, equations_per_corner> direction, moment;
};

// (r^2 - l^2) / 2l: near zero the error of the length, without a root.
double excess(const Vec3& link, double length) {
    return (link.normSqr() - length * length) / (2 * length);
}

// The chassis is the common ancestor of the bodies here, so Simbody gives their poses and motions relative to it.
class ArmsAndTieRods : public SimTK::Constraint::Custom::Implementation {
public:
    explicit ArmsAndTieRods(Parts& parts)
        : Implementation(parts.chassis.updMatterSubsystem()),
          inputs_(parts.inputs),
          chassis_(addConstrainedBody(parts.chassis)) {
        for (std::size_t i = 0; i < parts.corners.size(); ++i) {
            const CornerDescription& corner = parts.description.corners[i];
            if (!std::holds_alternative<MacPhersonDescription>(corner.suspension)) continue;
            corners_.emplace_back(Linkage(corner), addConstrainedBody(parts.corners[i].carrier));
        }
        setDefaultNumConstraintEquations(equations_per_corner * static_cast<int>(corners_.size()), 0, 0);
    }

    Implementation* clone() const override { return new ArmsAndTieRods(*this); }

    void realizePosition(const State& state) const override {
        for (const Corner& corner : corners_)
            corner.links = Links(corner.linkage, getBodyTransformFromState(state, corner.spindle), inputs_.rack);
    }

    void calcPositionErrors(const State&, const PerBody<Transform>& poses, const Coordinates&,
                            Equations& errors) const override {
        auto error = errors.begin();
        for (const auto& [linkage, spindle, unused] : corners_) {
            const Links links(linkage, poses[spindle], inputs_.rack);
            *error++ = ~linkage.arm_axis * links.arm;
            *error++ = excess(links.arm, linkage.arm_length);
            *error++ = excess(links.tie_rod, linkage.tie_rod_length);
        }
    }

    void calcPositionDotErrors(const State&, const PerBody<SpatialVec>& velocities, const Coordinates&,
                               Equations& rates) const override {
        auto rate = rates.begin();
        for (const Corner& corner : corners_) {
            const Links& links = corner.links;
            const SpatialVec& velocity = velocities[corner.spindle];
            for (int k = 0; k < equations_per_corner; ++k)
                *rate++ = ~links.moment[k] * velocity[0] + ~links.direction[k] * velocity[1];
            rate[-1] -= inputs_.rack_rate * (~links.direction[2] * corner.linkage.rack_axis);
        }
    }

    void calcPositionDotDotErrors(const State& state, const PerBody<SpatialVec>& accelerations, const Coordinates&,
                                  Equations& rates) const override {
        auto rate = rates.begin();
        for (const auto& [linkage, spindle, links] : corners_) {
            const SpatialVec& velocity = getBodyVelocityFromState(state, spindle);
            const SpatialVec& acceleration = accelerations[spindle];
            const Vec3 rack_axis(linkage.rack_axis);
            const Vec3 arm_rate = velocity[1] + velocity[0] % links.ball;
            const Vec3 tie_rod_rate = velocity[1] + velocity[0] % links.tie_rod_end - inputs_.rack_rate * rack_axis;
            for (int k = 0; k < equations_per_corner; ++k) {
                const Vec3& end = k == 2 ? links.tie_rod_end : links.ball;
                const Vec3 centripetal = velocity[0] % (velocity[0] % end);
                *rate++ = ~links.moment[k] * acceleration[0] + ~links.direction[k] * (acceleration[1] + centripetal);
            }
            rate[-2] += arm_rate.normSqr() / linkage.arm_length;
            rate[-1] += tie_rod_rate.normSqr() / linkage.tie_rod_length -
                        inputs_.rack_acceleration * (~links.direction[2] * rack_axis);
        }
    }

    // The rack's force ends in the chassis as well.
    void addInPositionConstraintForces(const State&, const Equations& multipliers, PerBody<SpatialVec>& loads,
                                       Coordinates&) const override {
        auto multiplier = multipliers.begin();
        for (const auto& [linkage, spindle, links] : corners_) {
            SpatialVec load(Vec3(0), Vec3(0));
            for (int k = 0; k < equations_per_corner; ++k, ++multiplier)
                load += *multiplier * SpatialVec(links.moment[k], links.direction[k]);
            loads[spindle] += load;
            loads[chassis_] -= SpatialVec(load[0] + links.wheel_center % load[1], load[1]);
        }
    }

private:
    struct Corner {
        Corner(const Linkage& l, ConstrainedBodyIndex body)
            : linkage(l), spindle(body), links(l, Transform(l.wheel_center), 0) {}

        Linkage linkage;
        ConstrainedBodyIndex spindle;
        mutable Links links;  // of the last realized position; there is one state only
    };

    const Inputs& inputs_;
    ConstrainedBodyIndex chassis_;
    std::vector<Corner> corners_;
};

}  // namespace

void add_strut(Parts& parts, const Linkage& linkage, const SimTK::MassProperties& mass, CornerParts& bodies) {
    const Rotation slide_frame(-linkage.slide_axis, SimTK::XAxis);
    bodies.piston_rod =
        MobilizedBody::Ball(parts.chassis, Transform(linkage.top), SimTK::Body::Massless(), Transform());
    bodies.carrier = MobilizedBody::Slider(bodies.piston_rod, Transform(slide_frame), SimTK::Body::Rigid(mass),
                                           Transform(slide_frame, linkage.slide - linkage.wheel_center));
}

void add_arms_and_tie_rods(Parts& parts) {
    SimTK::Constraint::Custom(new ArmsAndTieRods(parts));
}

}  // namespace hamilcar::oracle
