// Which page has control and what the pages are sent, with fake pages.
#include "hamilcar/live/connections.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "live/test_catalog.hpp"

namespace hamilcar::live {
namespace {

using testing::Contains;
using testing::HasSubstr;

class FakePage final : public Page {
public:
    void send_text(Message text) override { texts.push_back(*text); }
    void send_frame(Message) override { ++frames; }
    void send_tile(Message tile) override { tiles.push_back(*tile); }
    bool has_room() const override { return room; }
    long lost_frames() const override { return 7; }
    void disconnect(const char*) override { ++disconnected; }

    std::string last() const { return texts.empty() ? "" : texts.back(); }
    std::vector<std::string> texts, tiles;
    int frames = 0, disconnected = 0;
    bool room = true;
};

class ConnectionsTest : public testing::Test {
protected:
    bool becomes(Pause pause) {
        return becomes_true([&] { return connections.update(), session.progress().paused == pause; });
    }
    Session session{test_catalog(), {"car", "flat"}, scratch_folder()};
    Connections connections{session};
    FakePage first, second;
};

TEST_F(ConnectionsTest, FirstPageHasControl) {
    EXPECT_EQ(connections.add(first), 1u);
    EXPECT_EQ(connections.add(second), 2u);
    ASSERT_GE(second.texts.size(), 3u);
    EXPECT_THAT(second.texts[0], HasSubstr(R"("type":"hello")"));
    EXPECT_THAT(second.texts[0], HasSubstr(R"("page":2)"));
    EXPECT_THAT(second.texts[1], HasSubstr(R"("type":"car")"));
    EXPECT_THAT(second.texts[2], HasSubstr(R"("driver":1)"));
    EXPECT_THAT(second.texts[2], HasSubstr(R"("pages":2)"));
    EXPECT_THAT(second.texts[2], HasSubstr(R"("lost_frames":7)"));
    EXPECT_TRUE(becomes(Pause::none));
    EXPECT_TRUE(becomes_true([&] { return connections.update(), first.frames > 5 && second.frames > 5; }));
}

TEST_F(ConnectionsTest, AcceptsCommandsOnlyFromDriver) {
    connections.add(first), connections.add(second);
    connections.receive(2, R"({"type":"pause","on":true})");
    EXPECT_THAT(second.last(), HasSubstr("Page 1 has control"));
    connections.receive(2, R"({"type":"take"})");
    EXPECT_THAT(second.last(), HasSubstr("Page 1 has control"));
    const auto texts = second.texts.size();
    connections.receive(
        2, R"({"type":"input","sequence":1,"device":"keys","steer":0,"throttle":1,"brake":0,"reverse":false})");
    EXPECT_EQ(second.texts.size(), texts);  // ignored without an answer
    connections.receive(1, R"({"type":"take"})");
    EXPECT_THAT(first.texts, Not(Contains(HasSubstr("refusal"))));
    connections.receive(1, R"({"type":"pause","on":true})");
    EXPECT_TRUE(becomes(Pause::driver));
}

TEST_F(ConnectionsTest, SwitchesAidsForTheDriverAlone) {
    connections.add(first), connections.add(second);
    const char* off = R"({"type":"switch","aid":"esc","on":false})";
    connections.receive(1, off);
    EXPECT_THAT(first.last(), HasSubstr("This car has no 'esc'."));
    session.load({"aided", "flat"}, 1);
    ASSERT_TRUE(becomes_true([&] { return connections.update(), !session.simulation().aids().empty(); }));
    connections.receive(2, off);
    EXPECT_THAT(second.last(), HasSubstr("Page 1 has control"));
    connections.receive(1, off);
    connections.send_status();
    for (const FakePage& page : {first, second}) EXPECT_THAT(page.last(), HasSubstr(R"("switched_off":["esc"])"));
    connections.receive(1, R"({"type":"switch","aid":"esc","on":true})");
    connections.send_status();
    EXPECT_THAT(second.last(), HasSubstr(R"("switched_off":[])"));
}

TEST_F(ConnectionsTest, PausesUntilAnotherPageTakesControl) {
    connections.add(first), connections.add(second);
    ASSERT_TRUE(becomes(Pause::none));
    connections.remove(1);
    EXPECT_TRUE(becomes(Pause::no_driver));
    EXPECT_THAT(second.last(), HasSubstr(R"("driver":0)"));
    connections.receive(2, R"({"type":"reset"})");
    EXPECT_THAT(second.last(), HasSubstr("Take the wheel first."));
    connections.receive(2, R"({"type":"take"})");
    EXPECT_THAT(second.last(), HasSubstr(R"("driver":2)"));
    EXPECT_TRUE(becomes(Pause::none));
    connections.remove(2);
    EXPECT_TRUE(becomes(Pause::no_driver));
    FakePage third;
    connections.add(third);
    EXPECT_THAT(third.last(), HasSubstr(R"("driver":3)"));
    connections.remove(3);
}

// Good messages in between excuse nothing: only time does.
TEST_F(ConnectionsTest, DisconnectsAfterTooManyInvalidMessages) {
    connections.add(first);
    for (int i = 0; i < Connections::max_invalid_messages - 1; ++i) {
        connections.receive(1, "what");
        EXPECT_THAT(first.last(), HasSubstr("refusal"));
        connections.receive(1, R"({"type":"pause","on":false})");
    }
    EXPECT_EQ(first.disconnected, 0);
    connections.receive(1, "what");
    EXPECT_EQ(first.disconnected, 1);
}

TEST_F(ConnectionsTest, ForgivesOneInvalidMessageASecond) {
    connections.add(first), connections.add(second);
    for (int i = 0; i < 3 * Connections::max_invalid_messages; ++i) {
        connections.receive(1, "what");
        connections.forgive();
    }
    EXPECT_EQ(first.disconnected, 0);
    for (int i = 0; i < Connections::max_invalid_messages; ++i) connections.receive(2, "what");
    EXPECT_EQ(second.disconnected, 1);
    EXPECT_EQ(first.disconnected, 0);
    for (int i = 0; i < 100; ++i) connections.forgive();  // no credit is saved
    for (int i = 0; i < Connections::max_invalid_messages; ++i) connections.receive(1, "what");
    EXPECT_EQ(first.disconnected, 1);
}

TEST_F(ConnectionsTest, BroadcastsNewCarAndRefusesOnlyTheSender) {
    connections.add(first), connections.add(second);
    for (const char* unknown : {R"({"type":"load","vehicle":"boat","road":"flat","friction":1})",
                                R"({"type":"load","vehicle":"car","road":"sea","friction":1})"}) {
        connections.receive(1, unknown);
        EXPECT_THAT(first.last(), HasSubstr("There is no"));
    }
    connections.receive(1, R"({"type":"load","vehicle":"wreck","road":"flat","friction":1})");
    EXPECT_TRUE(
        becomes_true([&] { return connections.update(), first.last().find("no wheels") != std::string::npos; }));
    EXPECT_THAT(second.texts, Not(Contains(HasSubstr("refusal"))));
    connections.receive(1, R"({"type":"load","vehicle":"car","road":"waves","friction":0.5})");
    EXPECT_TRUE(becomes_true(
        [&] { return connections.update(), second.last().find(R"("road":"waves")") != std::string::npos; }));
}

TEST_F(ConnectionsTest, SendsResultOnceAndToLaterPages) {
    connections.add(first);
    session.load({"car", "gates"}, 1);
    ASSERT_TRUE(becomes_true([&] { return connections.update(), session.simulation().course() != nullptr; }));
    EXPECT_THAT(first.last(), HasSubstr(R"("title":"Gates")"));
    const auto results = [](const FakePage& page) {
        return std::count_if(page.texts.begin(), page.texts.end(), [](const std::string& text) {
            return text.find(R"("type":"result")") != std::string::npos;
        });
    };
    connections.receive(
        1, R"({"type":"input","sequence":1,"device":"keys","steer":0,"throttle":1,"brake":0,"reverse":false})");
    ASSERT_TRUE(becomes_true([&] { return connections.update(), results(first) > 0; }));
    const std::string result = first.last();
    EXPECT_THAT(result, HasSubstr(R"("passed":true)"));
    connections.add(second);
    EXPECT_EQ(second.last(), result);
    const int frames = first.frames;
    ASSERT_TRUE(becomes_true([&] { return connections.update(), first.frames > frames + 10; }));
    EXPECT_EQ(results(first), 1);
    connections.receive(1, R"({"type":"reset"})");
    ASSERT_TRUE(becomes_true([&] { return connections.update(), !session.simulation().frames().value().run.over; }));
    FakePage third;
    connections.add(third);
    EXPECT_EQ(results(third), 0);
    connections.remove(3);
}

TEST_F(ConnectionsTest, SendsEachTileOncePerPage) {
    connections.add(first);
    connections.send_tiles();
    EXPECT_TRUE(first.tiles.empty());  // the road is flat
    session.load({"car", "waves"}, 1);
    ASSERT_TRUE(becomes_true([&] { return connections.update(), session.simulation().uneven(); }));
    session.pause(true);
    connections.add(second);
    second.room = false;
    for (int i = 0; i < 40; ++i) connections.send_tiles();
    const std::size_t near = tiles_near(0, 0, 48).size();
    EXPECT_GE(first.tiles.size(), near);
    EXPECT_LE(first.tiles.size(), near + 10);  // it may have rolled a little
    EXPECT_EQ(std::set<std::string>(first.tiles.begin(), first.tiles.end()).size(), first.tiles.size());
    EXPECT_TRUE(second.tiles.empty());
    second.room = true;
    connections.send_tiles();
    EXPECT_EQ(second.tiles.size(), first.tiles.size());  // from the cache
}

TEST(TilesNear, AreCompleteAndSortedByDistance) {
    const auto indices = tiles_near(8, 8, 20);
    EXPECT_EQ(indices.front(), TileIndex(0, 0));
    EXPECT_EQ(indices.size(), 9u);
    EXPECT_EQ(tiles_near(-0.1, 0.1, 0.05), std::vector<TileIndex>{TileIndex(-1, 0)});
}

}  // namespace
}  // namespace hamilcar::live
