// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "buckens/page/view_page.h"

namespace buckens::cli {

/// Serves the page of a run to this machine, and renews it while the run goes on.
///
/// It listens on the loopback interface only, at a port that the system chooses. Addresses begin
/// with a random token: other users of the machine, and pages of other origins, do not know it.
/// Nothing but the page is served.
class LivePage {
 public:
  /// Begins to listen.
  /// @throws IoError if a directory holds no run, or the system grants no port
  LivePage(std::vector<std::filesystem::path> runs, std::filesystem::path template_html,
           page::ViewPageOptions options);
  ~LivePage();
  LivePage(const LivePage&) = delete;
  LivePage& operator=(const LivePage&) = delete;

  /// "http://127.0.0.1:40123/3f…/"
  const std::string& address() const;
  /// Answers requests until `is_over` says so.
  void serve(const std::function<bool()>& is_over);

 private:
  struct Server;
  std::unique_ptr<Server> server_;
};

}  // namespace buckens::cli
