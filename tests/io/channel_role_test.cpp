// Roles of channels by name: what a result file says is read back, and the page knows the same ones.
#include "hamilcar/io/channel_role.hpp"

#include <gtest/gtest.h>

#include <string>

#include "hamilcar/base/text.hpp"
#include "support/json_schema.hpp"

namespace hamilcar::io {
namespace {

TEST(ChannelRole, HasANameThatIsReadBackAndThatThePageKnows) {
    const nlohmann::json known = test::PageSchema().definition("channel_role")["enum"];
    EXPECT_EQ(known.size(), std::size_t{channel_role_count} - 1);
    for (int i = 1; i < channel_role_count; ++i) {
        const auto role = static_cast<ChannelRole>(i);
        EXPECT_EQ(role_named(text(role)), role);
        EXPECT_EQ(known[static_cast<std::size_t>(i) - 1], text(role));
    }
    EXPECT_EQ(role_named("of another version"), ChannelRole::none);
    EXPECT_EQ(role_named(""), ChannelRole::none);
}

TEST(ChannelRole, KnowsWhatOnlyMovesThePicture) {
    EXPECT_TRUE(is_motion(ChannelRole::contact_x));
    EXPECT_TRUE(is_motion(ChannelRole::ground_force_z));
    EXPECT_TRUE(is_motion(ChannelRole::pose_qz));
    EXPECT_FALSE(is_motion(ChannelRole::vertical_force));
    EXPECT_FALSE(is_motion(ChannelRole::wheel_spin));
    EXPECT_FALSE(is_motion(ChannelRole::none));
}

TEST(ChannelRole, IsShownInTheUnitThatPeopleRead) {
    EXPECT_EQ(display_unit(ChannelRole::longitudinal_velocity).unit, "km/h");
    EXPECT_EQ(27.5 * display_unit(ChannelRole::longitudinal_velocity).factor, 99);
    EXPECT_EQ(display_unit(ChannelRole::yaw_rate).unit, "");
    EXPECT_EQ(display_unit(ChannelRole::yaw_rate).factor, 1);
}

TEST(RoundOff, IsShownAsZeroByConsoleAndPageAlike) {
    EXPECT_EQ(round_off, test::PageSchema().constant("round_off"));
    EXPECT_EQ(without_round_off(-4.9e-17), 0);
    EXPECT_EQ(without_round_off(4.9e-9, 3e5), 0);
    EXPECT_EQ(without_round_off(2e-12), 2e-12);
    EXPECT_TRUE(std::isnan(without_round_off(std::nan(""))));
}

}  // namespace
}  // namespace hamilcar::io
