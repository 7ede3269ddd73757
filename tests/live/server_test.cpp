// The server on a real socket: responses, and isolation of pages from a misbehaving one.
#include "hamilcar/live/server.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hamilcar/live/connections.hpp"
#include "live/socket_client.hpp"
#include "live/test_catalog.hpp"

namespace hamilcar::live {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string page = "<!doctype html><title>Drive</title>";

class LiveServer : public testing::Test {
protected:
    void SetUp() override {
        thread =
            std::jthread([this](const std::stop_token& stop) { server.run([&] { return stop.stop_requested(); }); });
    }
    void TearDown() override { stop(); }
    void stop() {
        if (!thread.joinable()) return;
        thread.request_stop();
        thread.join();
    }

    std::string host() const { return "127.0.0.1:" + std::to_string(server.port()); }
    std::string answer(const std::string& request) const {
        SocketClient client(server.port());
        client.send(request);
        return client.rest();
    }
    std::string get(const std::string& target, const std::string& method = "GET", std::string from = "") const {
        if (from.empty()) from = host();
        return answer(method + " " + target + " HTTP/1.1\r\nHost: " + from + "\r\n\r\n");
    }
    std::string upgrade(const std::string& token, const std::string& origin) const {
        return "GET /live?token=" + token + " HTTP/1.1\r\nHost: " + host() + "\r\nOrigin: " + origin +
               "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
               "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
    }
    // A page that is connected and has received its hello.
    SocketClient connected(int receive_buffer = 0) const {
        SocketClient client(server.port(), receive_buffer);
        client.send(upgrade(server.token(), "http://" + host()));
        EXPECT_THAT(client.header(), HasSubstr("s3pPLMBiTxaQ9kYGzzhZRbK+xOo="));  // the answer of RFC 6455
        EXPECT_THAT(client.text_with("\"hello\""), HasSubstr("generator"));
        return client;
    }

    std::vector<std::string> lines;
    Session session{test_catalog(), {"car", "flat"}, scratch_folder()};
    Server server{session, {page, 0, [this](const std::string& line) { lines.push_back(line); }}};
    std::jthread thread;
};

TEST_F(LiveServer, ServesPageWithToken) {
    EXPECT_EQ(server.url(), "http://" + host() + "/?token=" + server.token());
    const std::string found = get("/?token=" + server.token());
    EXPECT_THAT(found, StartsWith("HTTP/1.1 200 "));
    EXPECT_THAT(found, HasSubstr("\r\n\r\n" + page));
    for (const char* header : {"text/html", "nosniff", "no-referrer", "no-store", "default-src 'none'"}) {
        EXPECT_THAT(found, HasSubstr(header));
    }
    EXPECT_THAT(found, HasSubstr("ws://" + host()));
    const std::string head = get("/?token=" + server.token(), "HEAD");
    EXPECT_THAT(head, HasSubstr("Content-Length: " + std::to_string(page.size())));
    EXPECT_THAT(head, testing::EndsWith("\r\n\r\n"));
}

TEST_F(LiveServer, RejectsUnauthorizedRequests) {
    const std::string with_token = "?token=" + server.token();
    EXPECT_THAT(get("/"), StartsWith("HTTP/1.1 403 "));
    EXPECT_THAT(get("/?token=0123"), StartsWith("HTTP/1.1 403 "));
    EXPECT_THAT(get("/?token=0123"), HasSubstr("open the address that it printed."));
    EXPECT_THAT(get("/" + with_token, "GET", "evil.example"), StartsWith("HTTP/1.1 403 "));
    EXPECT_THAT(get("/favicon.ico" + with_token), StartsWith("HTTP/1.1 404 "));
    EXPECT_THAT(get("/" + with_token, "POST"), StartsWith("HTTP/1.1 405 "));
    EXPECT_THAT(answer(upgrade(server.token(), "http://evil.example")), StartsWith("HTTP/1.1 403 "));
    EXPECT_THAT(answer(upgrade("0123", "http://" + host())), StartsWith("HTTP/1.1 403 "));
    EXPECT_THAT(get("/live" + with_token), StartsWith("HTTP/1.1 403 "));  // no Origin
    EXPECT_EQ(answer("nonsense\r\n\r\n"), "");
    EXPECT_EQ(answer(std::string(20000, 'x')), "");
    const std::string twice = "GET /" + with_token + " HTTP/1.1\r\nHost: " + host() + "\r\nHost: evil.example\r\n\r\n";
    EXPECT_THAT(answer(twice), StartsWith("HTTP/1.1 403 "));
}

TEST_F(LiveServer, ServesDriverAndViewer) {
    SocketClient driver = connected(), watcher = connected();
    driver.send_text(
        R"({"type":"input","sequence":42,"device":"keys","steer":0,"throttle":1,"brake":0,"reverse":false})");
    watcher.send_text(R"({"type":"reset"})");
    EXPECT_THAT(watcher.text_with("refusal"), HasSubstr("Page 1 has control; this page is a viewer."));
    bool arrived = false;
    for (auto frame = watcher.frame(); frame && !arrived; frame = watcher.frame()) {
        arrived = frame->opcode == 2 && frame->payload.at(0) == 1 && frame->payload.at(16) == 42;
    }
    EXPECT_TRUE(arrived);
    { const SocketClient gone = std::move(driver); }
    EXPECT_NE(watcher.text_with("\"status\"", R"("paused":"nobody")"), "");
    watcher.send_text(R"({"type":"take"})");
    EXPECT_NE(watcher.text_with("\"status\"", R"("driver":2)"), "");
    EXPECT_NE(watcher.text_with("\"status\"", R"("paused":"")"), "");
}

TEST_F(LiveServer, DisconnectsAfterLargeOrInvalidMessages) {
    SocketClient good = connected(), oversized = connected(), invalid = connected();
    oversized.send_text(std::string(5000, ' '));
    EXPECT_EQ(oversized.close_code(), 1009);
    for (int i = 0; i < Connections::max_invalid_messages; ++i) invalid.send_frame(i % 2 ? 1 : 2, "{\"type\":");
    EXPECT_NE(invalid.text_with("refusal"), "");
    EXPECT_EQ(invalid.close_code(), 1008);
    EXPECT_NE(good.text_with("\"status\"", R"("pages":1)"), "");
}

TEST_F(LiveServer, SlowPageDoesNotAffectOthers) {
    SocketClient good = connected();
    good.send_text(R"({"type":"load","vehicle":"car","road":"waves","friction":1})");  // tiles fill a queue sooner
    ASSERT_NE(good.text_with("\"waves\""), "");
    SocketClient slow = connected(4096);
    std::uint32_t frames = 0;
    std::string status;
    constexpr std::uint32_t many = 300;  // several seconds; together with the tiles more than the system's buffers hold
    for (auto frame = good.frame(); frame && frames < many; frame = good.frame()) {
        if (frame->opcode == 2 && frame->payload.at(0) == 1) ++frames;
        if (frame->opcode == 1) status = frame->payload;
    }
    EXPECT_EQ(frames, many);
    EXPECT_THAT(status, HasSubstr(R"("pages":2)"));
    std::string late = slow.text_with("\"status\"");
    while (late.find(R"("lost_frames":0)") != std::string::npos) late = slow.text_with("\"status\"");
    EXPECT_THAT(late, HasSubstr("lost_frames"));
}

TEST_F(LiveServer, AcceptsAtMostSixteenPages) {
    std::vector<SocketClient> pages;
    for (int i = 0; i < 16; ++i) pages.push_back(connected());
    EXPECT_THAT(answer(upgrade(server.token(), "http://" + host())), StartsWith("HTTP/1.1 503 "));
    pages.pop_back();
    EXPECT_TRUE(becomes_true([&] {
        SocketClient client(server.port());
        client.send(upgrade(server.token(), "http://" + host()));
        return client.header().starts_with("HTTP/1.1 101 ");
    }));
}

TEST_F(LiveServer, ClosesConnectionsOnShutdown) {
    SocketClient client = connected();
    stop();
    EXPECT_EQ(client.close_code(), 1001);
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_THAT(lines[0], HasSubstr("steps"));
}

TEST(Server, FailsOnOccupiedPort) {
    Session session(test_catalog(), {"car", "flat"}, scratch_folder());
    const Server server(session, {page});
    EXPECT_THROW(Server(session, {page, server.port()}), io::Error);
}

}  // namespace
}  // namespace hamilcar::live
