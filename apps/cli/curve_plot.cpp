// SPDX-License-Identifier: Apache-2.0
#include "cli/curve_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <fmt/format.h>

#include "cli/axis_scale.h"

#include "buckens/base/errors.h"
#include "buckens/files/output_file.h"

namespace buckens::cli {

namespace {

constexpr double kFontSize = 13;
constexpr double kPadding = 12;
constexpr double kLegendRow = 20;
constexpr double kLeft = 78;    // room for the labels of the y axis
constexpr double kBottom = 46;  // and of the x axis
constexpr double kPngScale = 2;

struct Colour {
  double r, g, b;
};
/// Okabe and Ito's colours, which people with any colour vision tell apart, without the yellow.
constexpr std::array kColours = {Colour{0.00, 0.45, 0.70}, Colour{0.84, 0.37, 0.00},
                                 Colour{0.00, 0.62, 0.45}, Colour{0.80, 0.47, 0.65},
                                 Colour{0.34, 0.71, 0.91}, Colour{0.90, 0.62, 0.00},
                                 Colour{0.25, 0.25, 0.25}};

/// The nth curve: colours first, then dashes.
void set_line_style(cairo_t* c, std::size_t n) {
  const Colour& colour = kColours[n % kColours.size()];
  cairo_set_source_rgb(c, colour.r, colour.g, colour.b);
  constexpr std::array<std::array<double, 2>, 3> dashes = {{{0, 0}, {7, 4}, {2, 3}}};
  const auto& dash = dashes[n / kColours.size() % dashes.size()];
  cairo_set_dash(c, dash.data(), dash[0] > 0 ? 2 : 0, 0);
  cairo_set_line_width(c, 1.5);
}

/// Points of a line that can be told apart: of each column of half a pixel the first, lowest,
/// highest and last.
std::vector<std::size_t> visible_points(const PlotCurve& curve, double from, double to,
                                        double pixels, bool is_increasing) {
  std::vector<std::size_t> out;
  const std::size_t count = curve.x.size();
  const auto columns = static_cast<std::size_t>(2 * pixels);
  if (!is_increasing || count < 8 * columns) {
    for (std::size_t i = 0; i < count; ++i) out.push_back(i);
    return out;
  }
  const auto column_of = [&](std::size_t i) {
    return std::floor((curve.x[i] - from) / (to - from) * static_cast<double>(columns));
  };
  for (std::size_t first = 0; first < count;) {
    std::size_t end = first + 1;
    while (end < count && column_of(end) == column_of(first)) ++end;
    const auto [low, high] = std::minmax_element(curve.y.begin() + static_cast<long>(first),
                                                 curve.y.begin() + static_cast<long>(end));
    std::array<std::size_t, 4> kept = {first, static_cast<std::size_t>(low - curve.y.begin()),
                                       static_cast<std::size_t>(high - curve.y.begin()), end - 1};
    std::sort(kept.begin(), kept.end());
    out.insert(out.end(), kept.begin(), std::unique(kept.begin(), kept.end()));
    first = end;
  }
  return out;
}

struct Range {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();

  void add(const std::vector<double>& values) {
    for (const double value : values) {
      if (!std::isfinite(value)) continue;
      least = std::min(least, value);
      most = std::max(most, value);
    }
  }
  AxisScale scale(const std::string& unit, bool is_tight, double room) const {
    const int ticks = std::clamp(static_cast<int>(room), 2, 12);
    return least <= most ? make_scale(least, most, unit, is_tight, ticks)
                         : make_scale(0, 1, unit, is_tight, ticks);
  }
};

class Drawing {
 public:
  Drawing(cairo_t* cairo, const PlotFigure& figure, double height)
      : c_(cairo), figure_(figure), height_(height) {
    cairo_select_font_face(c_, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(c_, kFontSize);
  }

  void run() {
    cairo_set_source_rgb(c_, 1, 1, 1);
    cairo_paint(c_);
    double top = kPadding;
    if (!figure_.title.empty()) {
      ink();
      text(figure_.title, figure_.width / 2, top + kFontSize, 0.5);
      top += kFontSize + kPadding;
    }
    Range x;
    for (const PlotPanel& panel : figure_.panels) {
      for (const PlotCurve& curve : panel.curves) x.add(curve.x);
    }
    x_ = x.scale(figure_.x_unit, figure_.is_x_increasing, figure_.width / 90);
    left_ = kLeft;
    right_ = figure_.width - 2 * kPadding;
    const double room = (height_ - top - kBottom) / static_cast<double>(figure_.panels.size());
    for (std::size_t k = 0; k < figure_.panels.size(); ++k) {
      const bool is_last = k + 1 == figure_.panels.size();
      draw_panel(figure_.panels[k], top, top + room - (is_last ? 0 : kPadding), is_last);
      top += room;
    }
  }

 private:
  void ink() { cairo_set_source_rgb(c_, 0.13, 0.13, 0.13); }

  double width_of(const std::string& words) {
    cairo_text_extents_t extents;
    cairo_text_extents(c_, words.c_str(), &extents);
    return extents.x_advance;
  }
  /// @param anchor 0: begins at x, ½: around x, 1: ends at x
  void text(const std::string& words, double x, double y, double anchor) {
    cairo_move_to(c_, x - anchor * width_of(words), y);
    cairo_show_text(c_, words.c_str());
  }
  void line(double x1, double y1, double x2, double y2) {
    cairo_move_to(c_, std::round(x1) + 0.5, std::round(y1) + 0.5);
    cairo_line_to(c_, std::round(x2) + 0.5, std::round(y2) + 0.5);
    cairo_stroke(c_);
  }

  double x_at(double value) const {
    return left_ + (value - x_.from) / (x_.to - x_.from) * (right_ - left_);
  }
  double y_at(double value) const {
    return low_ - (value - y_.from) / (y_.to - y_.from) * (low_ - high_);
  }

  /// Draws the names of the curves in rows and returns where they end.
  double draw_legend(const PlotPanel& panel, double top) {
    double x = left_;
    double y = top + kFontSize;
    for (std::size_t k = 0; k < panel.curves.size(); ++k) {
      const double width = 34 + width_of(panel.curves[k].label) + 18;
      if (x > left_ && x + width > right_) {
        x = left_;
        y += kLegendRow;
      }
      set_line_style(c_, k);
      cairo_move_to(c_, x, y - 4);
      cairo_line_to(c_, x + 26, y - 4);
      cairo_stroke(c_);
      ink();
      text(panel.curves[k].label, x + 34, y, 0);
      x += width;
    }
    cairo_set_dash(c_, nullptr, 0, 0);
    return y + 8;
  }

  void draw_panel(const PlotPanel& panel, double top, double bottom, bool has_x_labels) {
    high_ = draw_legend(panel, top);
    low_ = bottom;
    Range range;
    for (const PlotCurve& curve : panel.curves) range.add(curve.y);
    y_ = range.scale(panel.unit, false, (low_ - high_) / 45);
    draw_axes(has_x_labels);
    cairo_save(c_);
    cairo_rectangle(c_, left_, high_, right_ - left_, low_ - high_);
    cairo_clip(c_);
    cairo_set_line_join(c_, CAIRO_LINE_JOIN_ROUND);
    for (std::size_t k = 0; k < panel.curves.size(); ++k) {
      set_line_style(c_, k);
      draw_curve(panel.curves[k]);
    }
    cairo_restore(c_);
  }

  void draw_axes(bool has_x_labels) {
    cairo_set_line_width(c_, 1);
    for (std::size_t k = 0; k < x_.ticks.size(); ++k) {
      const double x = x_at(x_.ticks[k]);
      cairo_set_source_rgb(c_, 0.88, 0.88, 0.88);
      line(x, high_, x, low_);
      ink();
      if (has_x_labels) text(x_.labels[k], x, low_ + kFontSize + 5, 0.5);
    }
    for (std::size_t k = 0; k < y_.ticks.size(); ++k) {
      const double y = y_at(y_.ticks[k]);
      cairo_set_source_rgb(c_, 0.88, 0.88, 0.88);
      line(left_, y, right_, y);
      ink();
      text(y_.labels[k], left_ - 8, y + 0.35 * kFontSize, 1);
    }
    ink();
    cairo_rectangle(c_, std::round(left_) + 0.5, std::round(high_) + 0.5,
                    std::round(right_) - std::round(left_), std::round(low_) - std::round(high_));
    cairo_stroke(c_);
    if (has_x_labels) {
      text(with_unit(figure_.x_name, x_.unit), (left_ + right_) / 2, low_ + 2 * kFontSize + 13,
           0.5);
    }
    if (y_.unit.empty()) return;
    cairo_save(c_);
    cairo_translate(c_, kFontSize + 4, (low_ + high_) / 2);
    cairo_rotate(c_, -std::acos(0.0));
    text(fmt::format("[{}]", y_.unit), 0, 0, 0.5);
    cairo_restore(c_);
  }

  static std::string with_unit(const std::string& name, const std::string& unit) {
    return unit.empty() ? name : fmt::format("{} [{}]", name, unit);
  }

  void draw_curve(const PlotCurve& curve) {
    bool is_down = false;
    for (const std::size_t i :
         visible_points(curve, x_.from, x_.to, right_ - left_, figure_.is_x_increasing)) {
      if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) {
        is_down = false;
        continue;
      }
      (is_down ? cairo_line_to : cairo_move_to)(c_, x_at(curve.x[i]), y_at(curve.y[i]));
      is_down = true;
    }
    cairo_stroke(c_);
  }

  cairo_t* c_;
  const PlotFigure& figure_;
  double height_;
  AxisScale x_, y_;
  double left_ = 0, right_ = 0, high_ = 0, low_ = 0;
};

cairo_status_t append(void* text, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

std::string xml_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else {
      out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return out;
}

/// Cairo draws letters as outlines; title and description say in words what can be seen.
void add_words(const PlotFigure& figure, std::string& svg) {
  std::string curves;
  for (const PlotPanel& panel : figure.panels) {
    for (const PlotCurve& curve : panel.curves) {
      curves += fmt::format("{}{} [{}]", curves.empty() ? "" : ", ", curve.label, panel.unit);
    }
  }
  const std::size_t tag = svg.find("<svg");
  const std::size_t end = tag == svg.npos ? svg.npos : svg.find('>', tag);
  if (end == svg.npos) return;
  const std::string title = figure.title.empty() ? "Diagram" : figure.title;
  svg.insert(end + 1,
             fmt::format("\n<title>{}</title>\n<desc>{} over {} [{}]</desc>", xml_text(title),
                         xml_text(curves), xml_text(figure.x_name), xml_text(figure.x_unit)));
}

}  // namespace

void draw_figure(const PlotFigure& figure, const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  if (ending != ".svg" && ending != ".png" && ending != ".pdf") {
    throw InputError(
        fmt::format("{}: the file extension determines the picture format; use .svg, .png or .pdf",
                    path.string()));
  }
  const double height = figure.height > 0.0 ? figure.height
                        : figure.panels.size() == 1
                            ? 420.0
                            : 260.0 * static_cast<double>(figure.panels.size()) + 40.0;
  std::string bytes;
  const double points = 72.0 / 96.0;
  cairo_surface_t* raw = nullptr;
  if (ending == ".svg") {
    raw = cairo_svg_surface_create_for_stream(append, &bytes, figure.width, height);
  } else if (ending == ".pdf") {
    raw =
        cairo_pdf_surface_create_for_stream(append, &bytes, points * figure.width, points * height);
  } else {
    raw = cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                     static_cast<int>(std::ceil(kPngScale * figure.width)),
                                     static_cast<int>(std::ceil(kPngScale * height)));
  }
  const Surface surface(raw, cairo_surface_destroy);
  const Context context(cairo_create(surface.get()), cairo_destroy);
  if (ending == ".png") cairo_scale(context.get(), kPngScale, kPngScale);
  if (ending == ".pdf") cairo_scale(context.get(), points, points);
  Drawing(context.get(), figure, height).run();
  if (ending == ".png") cairo_surface_write_to_png_stream(surface.get(), append, &bytes);
  cairo_surface_finish(surface.get());
  const cairo_status_t status = cairo_status(context.get());
  if (status != CAIRO_STATUS_SUCCESS || bytes.empty()) {
    throw IoError(fmt::format("{}: the picture cannot be drawn: {}.", path.string(),
                              cairo_status_to_string(status)));
  }
  if (ending == ".svg") add_words(figure, bytes);
  files::replace_text_file(path, bytes);
}

}  // namespace buckens::cli
