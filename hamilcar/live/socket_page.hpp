// A page connected by a WebSocket. Only for server.cpp.
#pragma once

#include <algorithm>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <deque>
#include <list>
#include <memory>
#include <set>

#include "hamilcar/live/connections.hpp"
#include "hamilcar/live/http_request.hpp"

namespace hamilcar::live {

class SocketPage;

class HttpConnection;

// Shared by all connections. Who has shown a secret is a client, counted by what it was given; the others are strangers, the
// oldest first. `pages` are those to close on shutdown.
struct ServerState {
    Connections& connections;
    int downloads = 0, links = 0;
    std::list<HttpConnection*> strangers{};
    std::set<SocketPage*> pages{};
};

// Counts one client for as long as the connection is open.
class Slot {
public:
    explicit Slot(int& count) : count_(&count) { ++count; }
    Slot(Slot&& other) noexcept : count_(std::exchange(other.count_, nullptr)) {}
    Slot& operator=(Slot&&) = delete;
    ~Slot() {
        if (count_) --*count_;
    }

private:
    int* count_;
};

class SocketPage final : public Page, public std::enable_shared_from_this<SocketPage> {
public:
    SocketPage(beast::tcp_stream stream, ServerState& state)
        : stream_(std::move(stream)), state_(state), slot_(state.links) {}

    void accept(Upgrade request) {
        constexpr auto handshake_timeout = std::chrono::seconds(5), idle_timeout = std::chrono::seconds(30);
        constexpr std::size_t max_message_size = 4096;
        stream_.set_option(beast::websocket::stream_base::timeout{handshake_timeout, idle_timeout, true});
        stream_.read_message_max(max_message_size);
        stream_.auto_fragment(false);
        request_ = std::move(request);
        stream_.async_accept(request_, [self = shared_from_this()](beast::error_code error) {
            if (!error) self->start();
        });
    }

    void send_text(Message text) override { enqueue({std::move(text), false}); }
    void send_tile(Message tile) override { enqueue({std::move(tile), true}); }
    void send_frame(Message frame) override {
        if (std::exchange(frame_, std::move(frame))) ++lost_frames_;
        write();
    }
    bool has_room() const override { return queue_.size() < room_for_tiles; }
    long lost_frames() const override { return lost_frames_; }
    void disconnect(const char* reason) override { close({beast::websocket::close_code::policy_error, reason}); }
    void shut_down() { close(beast::websocket::close_code::going_away); }

private:
    static constexpr std::size_t room_for_tiles = 4, max_queued = 64;
    struct Outgoing {
        Message message;
        bool binary;
    };

    void start() {
        state_.pages.insert(this);
        number_ = state_.connections.add(*this);
        read();
    }

    void read() {
        stream_.async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
            if (error) return self->end();
            const std::string text = beast::buffers_to_string(self->buffer_.data());
            self->buffer_.consume(self->buffer_.size());
            if (!self->closing_) self->state_.connections.receive(self->number_, self->stream_.got_text() ? text : "");
            self->read();
        });
    }

    void end() {
        closing_ = true;
        state_.pages.erase(this);
        state_.connections.remove(number_);
        stream_.next_layer().close();
    }

    // A page that has not read for so long would not read a close reason either.
    void enqueue(Outgoing message) {
        if (queue_.size() >= max_queued) return stream_.next_layer().close();
        queue_.push_back(std::move(message));
        write();
    }

    void write() {
        if (writing_ || closing_ || (queue_.empty() && !frame_)) return;
        Outgoing next{frame_, true};
        if (queue_.empty()) {
            frame_ = nullptr;
        } else {
            next = std::move(queue_.front());
            queue_.pop_front();
        }
        writing_ = true;
        stream_.binary(next.binary);
        const auto bytes = boost::asio::buffer(*next.message);
        stream_.async_write(bytes, [self = shared_from_this(), next](beast::error_code error, std::size_t) {
            self->writing_ = false;
            if (!error) self->write();
        });
    }

    void close(const beast::websocket::close_reason& reason) {
        if (std::exchange(closing_, true)) return;
        stream_.async_close(reason, [self = shared_from_this()](beast::error_code) {});
    }

    beast::websocket::stream<beast::tcp_stream> stream_;
    ServerState& state_;
    Slot slot_;
    Upgrade request_;
    beast::flat_buffer buffer_;
    std::uint32_t number_ = 0;
    std::deque<Outgoing> queue_;
    Message frame_;
    bool writing_ = false, closing_ = false;
    long lost_frames_ = 0;
};

}  // namespace hamilcar::live
