// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace buckens::cli {

/// Asks the desktop to show a page, without waiting for it: the program xdg-open.
/// @param address of the page, or the name of its file
/// @throws IoError if there is no such program
void open_in_browser(const std::string& address);

}  // namespace buckens::cli
