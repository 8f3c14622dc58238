// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace buckens::cli {

/// A line in a diagram.
struct PlotCurve {
  std::string label;
  std::vector<double> x, y;  ///< as many as x
};

/// Curves with a common y axis.
struct PlotPanel {
  std::string unit;  ///< of y, SI
  std::vector<PlotCurve> curves;
};

/// A diagram: panels one below the other with a common x axis.
struct PlotFigure {
  std::string title;  ///< may be empty
  std::string x_name = "t";
  std::string x_unit = "s";     ///< SI
  bool is_x_increasing = true;  ///< allows thinning of long curves where it is not visible
  std::vector<PlotPanel> panels;
  double width = 800, height = 0;  ///< points of 1/96 inch; height 0: 420 for one panel, 260 each
};

/// Draws a figure into an .svg, .png or .pdf file. Values that are not finite leave a gap.
/// @throws InputError for any other file ending, IoError
void draw_figure(const PlotFigure& figure, const std::filesystem::path& path);

}  // namespace buckens::cli
