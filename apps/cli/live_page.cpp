// SPDX-License-Identifier: Apache-2.0
#include "cli/live_page.h"

#include <chrono>
#include <mutex>
#include <random>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/format.h>
#include <httplib.h>
#include <nlohmann/json.hpp>

#include "cli/output.h"

#include "buckens/base/errors.h"
#include "buckens/files/output_file.h"
#include "buckens/run_store/run_files.h"
#include "buckens/run_store/summary_json.h"

namespace buckens::cli {

namespace {

namespace fs = std::filesystem;

constexpr char kHost[] = "127.0.0.1";
constexpr std::size_t kThreads = 4;
constexpr std::chrono::milliseconds kLookInterval{50};  // for the user's wish to end

/// Shows the page in a frame, and puts a newer one in its place once that is drawn: what the user
/// has chosen is taken over.
constexpr char kFramePage[] = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Buckens</title>
<style>
  html, body { margin: 0; height: 100%; overflow: hidden; font: 13px system-ui, sans-serif }
  iframe { position: absolute; inset: 0; width: 100%; height: calc(100% - 22px); border: 0 }
  iframe.next { visibility: hidden }
  #state { position: absolute; bottom: 0; left: 0; right: 0; height: 22px; padding: 3px 12px;
           box-sizing: border-box; color: #fff; background: #1f6fc0; line-height: 16px }
  #state.ended { background: #5b6776 }
</style></head><body><div id="state" role="status">Waiting for the run</div>
<script>
  const bar = document.getElementById('state');
  let shown = null, version = '', pages = 0;
  const pause = (ms) => new Promise((done) => setTimeout(done, ms));
  const words = { starting: 'is being set up', running: 'goes on', finished: 'has reached its end',
                  interrupted: 'was interrupted' };

  function load() {
    return new Promise((done) => {
      const next = document.createElement('iframe');
      next.className = 'next';
      next.title = 'The run';
      next.addEventListener('load', () => done(next));
      next.src = 'page';
      document.body.append(next);
    });
  }

  async function renew() {
    const began = performance.now();
    const next = await load();
    const page = next.contentWindow.__buckens;
    if (!page && shown) return next.remove();
    const before = shown && shown.contentWindow.__buckens;
    if (before && page) page.adopt(JSON.parse(JSON.stringify(before.keep())));
    await pause(100);  // until it is drawn
    next.className = '';
    if (shown) shown.remove();
    shown = next;
    document.title = next.contentDocument.title;
    document.body.dataset.pages = String(++pages);
    await pause(4 * (performance.now() - began));  // large pages come more rarely
  }

  async function follow() {
    for (;;) {
      try {
        const state = await (await fetch('state')).json();
        bar.className = state.status === 'finished' || state.status === 'interrupted' ? 'ended' : '';
        bar.textContent = 'Live: the run ' + (words[state.status] || state.status);
        if (state.version !== version && state.version) {
          version = state.version;
          await renew();
        }
      } catch (error) {
        bar.className = 'ended';
        bar.textContent = 'buckens view --live has ended; this is the last it has shown';
      }
      await pause(1000);
    }
  }
  follow();
</script></body></html>
)";

std::string random_token() {
  std::random_device device;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", device());
  return token;
}

void require_run_to_show(const fs::path& directory) {
  std::error_code error;
  if (fs::is_regular_file(directory / run_store::kSummaryName, error)) return;
  throw IoError(
      fmt::format("{}: not a run directory: it holds no {}. Start the run first, or give "
                  "the directory that it writes (-o).",
                  directory.string(), run_store::kSummaryName));
}

/// Changes whenever the results do; empty before there are any.
std::string version_of(const fs::path& run) {
  std::error_code error;
  const fs::path results = run / run_store::kResultsName;
  const auto time = fs::last_write_time(results, error);
  if (error) return {};
  return fmt::format("{} {}", time.time_since_epoch().count(), fs::file_size(results, error));
}

}  // namespace

struct LivePage::Server {
  std::vector<fs::path> runs;
  fs::path template_html;
  page::ViewPageOptions options;
  std::string token = random_token();
  std::string address;
  int port = 0;
  httplib::Server http;
  std::mutex reading;  // HDF5 serves one thread at a time

  /// What the frame asks for again and again.
  std::string state() const {
    std::string version, status = "starting";
    for (const fs::path& run : runs) version += version_of(run);
    try {
      const fs::path summary = runs.front() / run_store::kSummaryName;
      status = run_store::to_string(
          run_store::status_in(files::read_text_file(summary), summary.string()));
    } catch (const IoError&) {  // it is just being replaced
    }
    return to_text({{"status", status}, {"version", version + (version.empty() ? "" : status)}});
  }

  void answer_page(httplib::Response& response) {
    const std::lock_guard lock(reading);
    try {
      std::vector<page::ViewPageReport> reports;
      response.set_content(page::view_page(runs, template_html, options, reports), "text/html");
    } catch (const Error& error) {
      response.status = 503;
      response.set_content(error.what(), "text/plain; charset=utf-8");
    }
  }

  /// A page of another origin that has made its name resolve to this machine gives itself away.
  bool is_from_here(const httplib::Request& request) const {
    const std::string host = request.get_header_value("Host");
    return host == fmt::format("{}:{}", kHost, port) || host == fmt::format("localhost:{}", port);
  }

  void set_up() {
    http.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
    http.set_keep_alive_max_count(1);  // a waiting connection would hold a thread
    http.set_default_headers({{"Cache-Control", "no-store"},
                              {"Referrer-Policy", "no-referrer"},
                              {"X-Content-Type-Options", "nosniff"},
                              {"X-Frame-Options", "SAMEORIGIN"},
                              {"Cross-Origin-Resource-Policy", "same-origin"}});
    http.set_pre_routing_handler(
        [this](const httplib::Request& request, httplib::Response& response) {
          if (is_from_here(request)) return httplib::Server::HandlerResponse::Unhandled;
          response.status = 403;
          return httplib::Server::HandlerResponse::Handled;
        });
    const std::string root = "/" + token + "/";
    http.Get(root, [](const httplib::Request&, httplib::Response& response) {
      response.set_content(kFramePage, "text/html");
    });
    http.Get(root + "state", [this](const httplib::Request&, httplib::Response& response) {
      response.set_content(state(), "application/json");
    });
    http.Get(root + "page", [this](const httplib::Request&, httplib::Response& response) {
      answer_page(response);
    });
    port = http.bind_to_any_port(kHost);
    if (port <= 0) throw IoError("--live: no port is available on 127.0.0.1");
    address = fmt::format("http://{}:{}{}", kHost, port, root);
  }
};

LivePage::LivePage(std::vector<fs::path> runs, fs::path template_html,
                   page::ViewPageOptions options)
    : server_(std::make_unique<Server>()) {
  for (const fs::path& run : runs) require_run_to_show(run);
  server_->runs = std::move(runs);
  server_->template_html = std::move(template_html);
  server_->options = std::move(options);
  server_->set_up();
}

LivePage::~LivePage() = default;

const std::string& LivePage::address() const { return server_->address; }

void LivePage::serve(const std::function<bool()>& is_over) {
  std::thread listener([this] { server_->http.listen_after_bind(); });
  while (!is_over()) std::this_thread::sleep_for(kLookInterval);
  server_->http.stop();
  listener.join();
}

}  // namespace buckens::cli
