#include "hamilcar/suspension/attachments.hpp"

#include <algorithm>
#include <cctype>

#include "hamilcar/base/assert.hpp"
#include "hamilcar/math/convert.hpp"

namespace hamilcar {

namespace {

constexpr std::array<std::string_view, 2> sides{"left ", "right "};

// "lower_link" of "left lower link", where a composition holds both.
std::string key_in(const Composition& composition, std::string_view name) {
    for (const std::string_view side : sides) {
        if (composition.carriers.size() == 2 && name.starts_with(side)) name.remove_prefix(side.size());
    }
    return link_key(name);
}

bool is_link(const CutJointDescription& cut) {
    return (cut.kind == CutJoint::distance || cut.kind == CutJoint::revolute_spherical) && cut.drive == Point{};
}

// The link's outer end, which is not where it is held if the link has a length of its own.
Point outer_end(const CutJointDescription& cut) {
    if (!cut.length) return cut.tip;
    Vec3<double> inner = vec3(cut.foot);
    const Vec3<double> tip = vec3(cut.tip), axis = vec3(cut.axis);
    if (cut.kind == CutJoint::revolute_spherical) inner += axis * axis.dot(tip - inner);
    const Vec3<double> outer = inner + (tip - inner).normalized() * *cut.length;
    return {outer[0], outer[1], outer[2]};
}

// The tree joint that carries the link, and its outer end as a cut joint in the link's place.
std::size_t link_part(Composition& to, CutJointDescription& cut) {
    std::size_t part = 0;
    if (cut.kind == CutJoint::distance) {
        const std::array<Point, 2> axes = link_axes(cut.foot, cut.tip);
        part = to.join(TreeJoint::universal, cut.name, cut.base, cut.foot, axes[0], axes[1]);
    } else {
        part = to.join(TreeJoint::revolute, cut.name, cut.base, cut.foot, cut.axis);
        to.linkage.joints.back().other_bush = cut.other_bush;
    }
    cut = {.kind = CutJoint::spherical,
           .name = cut.name + " ball",
           .part = cut.part,
           .base = part,
           .tip = cut.tip,
           .foot = outer_end(cut)};
    return part;
}

}  // namespace

std::string link_key(std::string_view name) {
    std::string key(name);
    for (char& c : key) {
        const auto letter = static_cast<unsigned char>(c);
        c = std::isalnum(letter) ? static_cast<char>(std::tolower(letter)) : '_';
    }
    return key;
}

std::vector<std::string> link_keys(const Composition& composition) {
    std::vector<std::string> keys;
    if (composition.links_are_equivalent) return keys;
    for (const CutJointDescription& cut : composition.linkage.cuts) {
        const std::string key = key_in(composition, cut.name);
        if (is_link(cut) && std::ranges::find(keys, key) == keys.end()) keys.push_back(key);
    }
    return keys;
}

void make_part(Composition& composition, std::string_view key) {
    PartChoice choice{.name = std::string(key), .left = 0, .right = 0, .has_table = true};
    for (CutJointDescription& cut : composition.linkage.cuts) {
        if (!is_link(cut) || key_in(composition, cut.name) != key) continue;
        const std::size_t part = link_part(composition, cut);
        (choice.left == 0 ? choice.left : choice.right) = part;
    }
    HAMILCAR_ASSERT(choice.left != 0);
    if (choice.right == 0) choice.right = choice.left;
    composition.parts.push_back(choice);
}

void add_bar_arm(Composition& composition, const std::string& side, const BarArm& arm) {
    composition.bar_arms.push_back(composition.linkage.coordinate_count());
    const std::size_t part = composition.join(TreeJoint::revolute, side + "bar arm", 0, arm.pivot, {0, 1, 0});
    composition.cut(CutJoint::distance, side + "drop link", arm.part, arm.link, part, arm.end);
}

}  // namespace hamilcar
