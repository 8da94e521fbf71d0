#include "page.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "failure.hpp"
#include "false_colour.hpp"
#include "page_template.hpp"
#include "page_text.hpp"

namespace ppm::compare {
namespace {

constexpr double kCropPixels = 160.0;  // CSS pixels that a crop is wide
constexpr double kNarrowestPane = 240.0, kWidestPane = 420.0;

/// Pictures that the page uses more than once are there once, as classes of the style sheet.
class Pictures {
 public:
  /// The class of a picture.
  std::string add(const PagePicture& picture) {
    const std::string name = fmt::format("p{}", count_++);
    rules_ += fmt::format(".{} {{ background-image: url(data:image/png;base64,{}); }}\n", name,
                          base64(picture.png));
    return name;
  }
  const std::string& rules() const { return rules_; }

 private:
  std::size_t count_ = 0;
  std::string rules_;
};

/// A column's pictures: classes, and captions between bars.
struct Shown {
  std::string title;
  std::string classes, last, captions, last_caption;
};

Shown add_all(Pictures& pictures, const std::string& title, const std::vector<PagePicture>& list) {
  Shown shown{title, "", "", "", ""};
  for (const PagePicture& picture : list) {
    shown.last = pictures.add(picture);
    shown.last_caption = picture.caption;
    shown.classes += (shown.classes.empty() ? "" : " ") + shown.last;
    shown.captions += (shown.captions.empty() ? "" : "|") + picture.caption;
  }
  return shown;
}

std::string pane(const Shown& shown, const char* what) {
  return fmt::format(
      "<figure><div class=\"pane {}\" tabindex=\"0\" role=\"img\" aria-label=\"{}{}\" "
      "data-pictures=\"{}\" data-captions=\"{}\"></div><figcaption><b>{}</b> <span "
      "class=\"caption\">{}</span></figcaption></figure>\n",
      shown.last, what, escape_html(shown.title), shown.classes, escape_html(shown.captions),
      escape_html(shown.title), escape_html(shown.last_caption));
}

std::string crop_table(const PageContent& content, const std::vector<Shown>& columns) {
  if (content.crops.empty()) return "";
  std::string html = "<h2>Crops</h2>\n<div class=\"crops\"><table>\n<tr><th></th>";
  for (const Shown& column : columns) {
    html += fmt::format("<th>{}</th>", escape_html(column.title));
  }
  html += "</tr>\n";
  for (const Crop& crop : content.crops) {
    html += fmt::format("<tr><th>{} &times; {}<br>at {}, {}</th>", crop.width, crop.height, crop.x,
                        crop.y);
    const double scale = kCropPixels / crop.width;
    for (const Shown& column : columns) {
      html += fmt::format(
          "<td><div class=\"crop {}\" data-pictures=\"{}\" "
          "style=\"width:{:.1f}px;height:{:.1f}px;background-size:{:.1f}px {:.1f}px;"
          "background-position:{:.1f}px {:.1f}px\"></div></td>",
          column.last, column.classes, kCropPixels, scale * crop.height, scale * content.width,
          scale * content.height, -scale * crop.x, -scale * crop.y);
    }
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

std::string error_row(const std::vector<Shown>& errors) {
  if (errors.empty()) return "";
  std::string html = fmt::format(
      "<h2>Relative errors</h2>\n<div class=\"controls\"><span>{}</span><span "
      "class=\"scale\"></span><span>{} and more</span><span class=\"hint\">one scale for all, "
      "logarithmic; grey: not a number</span></div>\n<div class=\"row\">\n",
      short_number(kLeastError), short_number(kMostError));
  for (const Shown& column : errors) html += pane(column, "Errors of ");
  return html + "</div>\n";
}

std::string paragraphs(const std::vector<std::string>& texts, const char* kind) {
  std::string html;
  for (const std::string& text : texts) {
    html += fmt::format("<p{}>{}</p>\n", kind, escape_html(text));
  }
  return html;
}

std::string fact_list(const Facts& facts) {
  std::string html = "<dl>\n";
  for (const auto& [name, value] : facts) {
    html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escape_html(name), escape_html(value));
  }
  return html + "</dl>\n";
}

std::string table_row(const std::vector<std::string>& cells, const char* tag) {
  std::string html = "<tr>";
  for (const std::string& cell : cells) {
    html += fmt::format("<{}>{}</{}>", tag, escape_html(cell), tag);
  }
  return html + "</tr>\n";
}

std::string plots(const std::vector<Plot>& list) {
  std::string html;
  for (const Plot& plot : list) html += "<div>" + svg_plot(plot) + "</div>\n";
  return html;
}

using Places = std::map<std::string, std::string, std::less<>>;

/// The template with its places filled. What fills them is not searched for places.
std::string filled(std::string_view text, const Places& places) {
  std::string html;
  for (;;) {
    const std::size_t start = text.find("{{");
    html += text.substr(0, start);
    if (start == std::string_view::npos) return html;
    const std::size_t end = text.find("}}", start);
    PPM_ASSERT(end != std::string_view::npos, "page.html: {{ without }}");
    const auto place = places.find(text.substr(start + 2, end - start - 2));
    PPM_ASSERT(place != places.end(), std::string(text.substr(start, end - start)));
    html += place->second;
    text.remove_prefix(end + 2);
  }
}

}  // namespace

std::string page_html(const PageContent& content) {
  Pictures pictures;
  std::vector<Shown> columns, errors;
  for (const PageColumn& column : content.columns) {
    columns.push_back(add_all(pictures, column.title, column.pictures));
    if (!column.errors.empty()) {
      errors.push_back(add_all(pictures, column.title, column.errors));
    }
  }
  Places places;
  places["title"] = escape_html(content.title);
  places["summary"] = paragraphs(content.summary, "");
  places["failures"] = content.failures.empty() ? ""
                                                : "<div class=\"failures\">\n" +
                                                      paragraphs(content.failures, "") + "</div>\n";
  for (const Shown& column : columns) places["pictures"] += pane(column, "");
  places["errors"] = error_row(errors);
  places["crops"] = crop_table(content, columns);
  places["curves"] = plots(content.curves);
  places["table"] = table_row(content.table_heading, "th");
  for (const auto& row : content.table) places["table"] += table_row(row, "td");
  places["table_notes"] = paragraphs(content.table_notes, " class=\"hint\"");
  places["figure4"] = content.figure4.empty()
                          ? ""
                          : "<h2>Hit points against passes (the paper's Figure 4)</h2>\n<div "
                            "class=\"plots\">\n" +
                                plots(content.figure4) + "</div>\n";
  places["figure5"] = "";
  if (!content.figure5.empty()) {
    places["figure5"] =
        "<h2>More and more passes (the paper's Figure 5)</h2>\n<div class=\"row\">\n";
    for (const PagePicture& picture : content.figure5) {
      places["figure5"] += pane(add_all(pictures, picture.caption, {{picture.png, ""}}), "");
    }
    places["figure5"] += "</div>\n";
  }
  places["facts"] = fact_list(content.facts);
  for (const auto& [method, facts] : content.parameters) {
    places["parameters"] +=
        fmt::format("<details><summary>Parameters of {}</summary>\n{}</details>\n",
                    escape_html(method), fact_list(facts));
  }
  for (const auto& [link, what] : content.files) {
    places["files"] += fmt::format("<dt><a href=\"{}\">{}</a></dt><dd>{}</dd>\n", escape_html(link),
                                   escape_html(link), escape_html(what));
  }
  for (const char* optional : {"pictures", "parameters", "files"}) places.try_emplace(optional);
  places["picture_rules"] = pictures.rules();
  places["gradient"] = error_gradient();
  places["width"] = std::to_string(content.width);
  places["height"] = std::to_string(content.height);
  places["aspect"] = fmt::format("{} / {}", content.width, content.height);
  places["pane_width"] = fmt::format(
      "{:.0f}", std::clamp(static_cast<double>(content.width), kNarrowestPane, kWidestPane));
  return filled(kPageTemplate, places);
}

}  // namespace ppm::compare
