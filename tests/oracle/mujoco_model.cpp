// The car in MuJoCo's XML format. A spindle is attached by a ball joint at the strut's top and slides along its own strut; the
// control arm is two massless rods from the ball joint to its bushes, the tie rod a third one to a rack on a slide. The
// rods are tendons, held at their lengths. All forces are applied from outside, with three user states per wheel.

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "support/hardpoints.hpp"
#include "tests/oracle/mujoco_parts.hpp"

namespace hamilcar::oracle {

namespace {

// The split between carrier and wheel does not change the motion, as the wheel is a body of revolution; it only has to
// leave two bodies that can exist. A disc without thickness has 0.5 here.
constexpr double wheel_mass_share = 0.1;
constexpr double transverse_over_spin_inertia = 0.55;

bool is_strut(const SuspensionDescription& suspension) {
    return suspension.keyword == "macpherson";
}

// What is at a distance from its own center of mass, per mass.
Matrix3d steiner(const Vector3d& arm) {
    return arm.squaredNorm() * Matrix3d::Identity() - arm * arm.transpose();
}

std::string text(const Vector3d& a) {
    return fmt::format("{} {} {}", a[0], a[1], a[2]);
}

std::string inertial(double mass, const Vector3d& center, const Matrix3d& inertia) {
    return fmt::format(R"(<inertial mass="{}" pos="{}" fullinertia="{} {} {} {} {} {}"/>)", mass, text(center),
                       inertia(0, 0), inertia(1, 1), inertia(2, 2), inertia(0, 1), inertia(0, 2), inertia(1, 2));
}

Matrix3d inertia_of(const BodyDescription& body) {
    const auto& [xx, yy, zz] = body.inertia;
    const auto& [xy, yz, xz] = body.products;
    return Matrix3d{{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}};
}

Vector3d spin_axis(const SuspensionDescription& suspension) {
    return to_vector(suspension.wheels[0].wheel.spin_axis).normalized();
}

std::string wheel_inertial(const SuspensionDescription& suspension) {
    const Vector3d axis = spin_axis(suspension);
    const Matrix3d along = axis * axis.transpose();
    return inertial(wheel_mass_share * suspension.bodies[0].body.mass, Vector3d::Zero(),
                    suspension.wheels[0].wheel.spin_inertia *
                        (along + transverse_over_spin_inertia * (Matrix3d::Identity() - along)));
}

// What the wheel's body leaves of the carrier, in a frame at the wheel center.
std::string carrier_inertial(const SuspensionDescription& suspension) {
    const BodyDescription& body = suspension.bodies[0].body;
    const Vector3d arm = to_vector(body.center_of_mass) - to_vector(suspension.wheels[0].wheel.center);
    const double mass = (1 - wheel_mass_share) * body.mass;
    const Vector3d center = arm * body.mass / mass;
    const Matrix3d wheel =
        transverse_over_spin_inertia * suspension.wheels[0].wheel.spin_inertia * steiner(spin_axis(suspension));
    return inertial(mass, center, inertia_of(body) + body.mass * steiner(arm) - wheel - mass * steiner(center));
}

std::string site(const std::string& name, const Vector3d& at) {
    return fmt::format(R"(<site name="{}" pos="{}"/>)", name, text(at)) + "\n";
}

std::string joint(const std::string& name, const char* type, const Vector3d& at, const Vector3d& axis,
                  double armature = 0) {
    return fmt::format(R"(<joint name="{}" type="{}" pos="{}" axis="{}" armature="{}"/>)", name, type, text(at),
                       text(axis), armature) +
           "\n";
}

// MuJoCo moves a body by its joints in turn: the slide's axis has turned with the ball, so it always passes through T.
std::string strut_joints(const SuspensionDescription& suspension, const test::MacPhersonPoints& strut) {
    const Vector3d top = to_vector(strut.strut_top) - to_vector(suspension.wheels[0].wheel.center);
    return joint(suspension.name + "_ball", "ball", top, Vector3d::UnitZ()) +
           joint(suspension.name, "slide", top, to_vector(strut.slide_point) - to_vector(strut.strut_top));
}

// The hinge's axis points to the left on both sides: a trailing wheel then rises with a positive angle.
std::string arm_joint(const SuspensionDescription& suspension, const test::SemiTrailingArmPoints& arm) {
    Vector3d axis = to_vector(arm.outer_bush) - to_vector(arm.inner_bush);
    if (axis[1] < 0) axis = -axis;
    return joint(suspension.name, "hinge", to_vector(arm.inner_bush) - to_vector(suspension.wheels[0].wheel.center),
                 axis);
}

// The paper's two suspensions, steered struts and arms.
void check(const SuspensionDescription& suspension) {
    const bool strut = is_strut(suspension);
    const auto reject = [&](bool wrong, const char* complaint) {
        if (wrong) throw std::invalid_argument(suspension.name + ": this engine " + complaint);
    };
    reject(!strut && suspension.keyword != "semi_trailing_arm", "knows struts and semi-trailing arms alone");
    reject(suspension.unit != 0, "has no trailers");
    reject(strut && to_vector(test::strut_points(suspension).rack_axis).isZero(), "moves every strut's rack end");
}

std::string write_bodies(const SuspensionDescription& suspension) {
    const std::string& name = suspension.name;
    const Vector3d center = to_vector(suspension.wheels[0].wheel.center);
    const test::PaperPoints points = test::paper_points(suspension);
    const auto* strut = std::get_if<test::MacPhersonPoints>(&points);
    std::string out =
        fmt::format(R"(<body name="{}" pos="{}">)", name, text(center)) + "\n" + carrier_inertial(suspension) + "\n";
    if (strut) {
        out += strut_joints(suspension, *strut) + site(name + "_ball_joint", to_vector(strut->ball_joint) - center) +
               site(name + "_tie_rod", to_vector(strut->tie_rod_outer) - center);
    } else {
        out += arm_joint(suspension, std::get<test::SemiTrailingArmPoints>(points));
    }
    out += fmt::format(R"(<body name="{}_wheel">)", name) + "\n" + wheel_inertial(suspension) + "\n" +
           joint(name + "_wheel", "hinge", Vector3d::Zero(), spin_axis(suspension)) + "</body>\n</body>\n";
    if (!strut) return out;
    out +=
        site(name + "_arm_front", to_vector(strut->arm_front)) + site(name + "_arm_rear", to_vector(strut->arm_rear));
    out += fmt::format(R"(<body name="{}_rack" pos="{}">)", name, text(to_vector(strut->rack_end))) + "\n" +
           inertial(rack_mass, Vector3d::Zero(), rack_mass * Matrix3d::Identity()) + "\n" +
           joint(name + "_rack", "slide", Vector3d::Zero(), to_vector(strut->rack_axis), rack_armature) +
           site(name + "_rack_end", Vector3d::Zero()) + "</body>\n";
    return out;
}

struct Rod {
    std::string on_chassis, on_spindle;  // sites
    double at_design, length;            // between the sites of the description, and as it should be [m]
};

// An arm of a length of its own still has its ball joint's foot where the description has it.
std::array<Rod, rods_per_strut> rods_of(const SuspensionDescription& suspension, const test::MacPhersonPoints& strut) {
    const std::string& name = suspension.name;
    const Vector3d front = to_vector(strut.arm_front), rear = to_vector(strut.arm_rear);
    const Vector3d ball = to_vector(strut.ball_joint), outer = to_vector(strut.tie_rod_outer);
    const Vector3d axis = (rear - front).normalized();
    const Vector3d foot = front + axis.dot(ball - front) * axis;
    const double radius = strut.arm_length.value_or((ball - foot).norm());
    const auto rod_to = [&](const Vector3d& bush) { return std::hypot(radius, (bush - foot).norm()); };
    const double tie_rod = (outer - to_vector(strut.rack_end)).norm();
    return {{{name + "_arm_front", name + "_ball_joint", (ball - front).norm(), rod_to(front)},
             {name + "_arm_rear", name + "_ball_joint", (ball - rear).norm(), rod_to(rear)},
             {name + "_rack_end", name + "_tie_rod", tie_rod, strut.tie_rod_length.value_or(tie_rod)}}};
}

// One iteration: with nothing but equalities MuJoCo minimizes a quadratic, and Newton's first step ends at its minimum.
std::string option(const MujocoOptions& options, double gravity) {
    const char* integrators[] = {"Euler", "implicit", "RK4"};
    return fmt::format(R"(<compiler angle="radian" inertiafromgeom="false"/>
<option timestep="{}" integrator="{}" gravity="0 0 {}" solver="Newton" iterations="1" jacobian="dense">
<flag contact="disable"/></option>
)",
                       options.step, integrators[static_cast<int>(options.integrator)], -gravity);
}

}  // namespace

std::string write_model(const VehicleDescription& car, const MujocoOptions& options) {
    std::string bodies, tendons, loops, states;
    const auto& reference = options.loops.reference;
    const std::string softness = fmt::format(R"(solref="{} {}" solimp="{}")", reference[0], reference[1],
                                             fmt::join(options.loops.impedance, " "));
    for (const SuspensionDescription& suspension : car.suspensions) {
        check(suspension);
        bodies += write_bodies(suspension);
        // No force comes of these: they make MuJoCo integrate u, v and b together with the motion.
        for (const char* state : {"u", "v", "b"})
            states += fmt::format(R"(<general name="{0}_{1}" joint="{0}_wheel" dyntype="user" gainprm="0"/>)",
                                  suspension.name, state) +
                      "\n";
        if (!is_strut(suspension)) continue;
        for (const Rod& rod : rods_of(suspension, test::strut_points(suspension))) {
            tendons += fmt::format(R"(<spatial name="{0}"><site site="{0}"/><site site="{1}"/></spatial>)",
                                   rod.on_chassis, rod.on_spindle) +
                       "\n";
            loops += fmt::format(R"(<tendon tendon1="{}" polycoef="{} 0 0 0 0" {}/>)", rod.on_chassis,
                                 rod.length - rod.at_design, softness) +
                     "\n";
        }
    }
    const Vector3d center = to_vector(car.chassis.center_of_mass);
    return "<mujoco>\n" + option(options, car.gravity) + "<worldbody>\n<body name=\"chassis\">\n" + "<freejoint/>\n" +
           inertial(car.chassis.mass, center, inertia_of(car.chassis)) + "\n" + bodies +
           "</body>\n</worldbody>\n<tendon>\n" + tendons + "</tendon>\n<equality>\n" + loops +
           "</equality>\n<actuator>\n" + states + "</actuator>\n</mujoco>\n";
}

ModelPointer load_model(const std::string& text) {
    const char* name = "car.xml";
    const auto files = std::make_unique<mjVFS>();  // two megabytes of names: not for the stack
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), name, static_cast<int>(text.size()));
    text.copy(static_cast<char*>(files->filedata[mj_findFileVFS(files.get(), name)]), text.size());
    char complaint[1000] = "";
    ModelPointer model(mj_loadXML(name, files.get(), complaint, sizeof complaint), mj_deleteModel);
    mj_deleteVFS(files.get());
    if (!model) throw std::runtime_error("MuJoCo rejects the car: " + std::string(complaint));
    return model;
}

SuspensionIndices find_suspension(const mjModel& model, const SuspensionDescription& suspension) {
    const auto find = [&](mjtObj kind, const std::string& suffix) {
        return mj_name2id(&model, kind, (suspension.name + suffix).c_str());
    };
    SuspensionIndices at;
    at.carrier = find(mjOBJ_BODY, "");
    at.wheel = find(mjOBJ_BODY, "_wheel");
    at.spin_v = model.jnt_dofadr[find(mjOBJ_JOINT, "_wheel")];
    at.independent_q = model.jnt_qposadr[find(mjOBJ_JOINT, "")];
    at.independent_v = model.jnt_dofadr[find(mjOBJ_JOINT, "")];
    at.states = find(mjOBJ_ACTUATOR, "_u");
    if (!is_strut(suspension)) return at;
    at.ball_q = model.jnt_qposadr[find(mjOBJ_JOINT, "_ball")];
    at.ball_v = model.jnt_dofadr[find(mjOBJ_JOINT, "_ball")];
    at.rack_q = model.jnt_qposadr[find(mjOBJ_JOINT, "_rack")];
    at.rack_v = model.jnt_dofadr[find(mjOBJ_JOINT, "_rack")];
    at.first_rod = find(mjOBJ_TENDON, "_arm_front");
    const auto rods = rods_of(suspension, test::strut_points(suspension));
    for (std::size_t i = 0; i < rods.size(); ++i) at.rods[i] = rods[i].length;
    return at;
}

}  // namespace hamilcar::oracle
