// SPDX-License-Identifier: Apache-2.0
#include "tools/demo/demo_page.h"

#include "mapping/report/html.h"

namespace oikos::demo {

namespace {

constexpr const char* kHead =
    "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>Oikos: the demo apartment</title>\n<style>\n"
    "body { font-family: system-ui, sans-serif; max-width: 72rem; margin: 2rem auto; padding: 0 1rem; color: #222; }\n"
    "img { max-width: 100%; }\n.frames { display: grid; grid-template-columns: repeat(4, 1fr); gap: .4rem; }\n"
    "table { border-collapse: collapse; }\ntd { padding: .25rem 1rem .25rem 0; vertical-align: top; }\n"
    "td:first-child { color: #555; }\nth { text-align: left; padding: .25rem 1rem .25rem 0; }\n.events { display: grid;"
    " grid-template-columns: repeat(3, 1fr); gap: 1rem; }\n.events figure { margin: 0; }\n.events img { max-height: 16rem; "
    "}\n</style>\n</head>\n<body>\n<h1>The demo apartment</h1>\n";

std::string image(const std::string& bytes, const std::string& type, const std::string& alternative) {
  return "<img alt=\"" + alternative + "\" src=\"data:image/" + type + ";base64," + mapping::base64(bytes) + "\">\n";
}

std::string table(const std::vector<std::pair<std::string, std::string>>& rows) {
  std::string html = "<table>\n";
  for (const auto& [name, value] : rows) {
    html += "<tr><td>" + mapping::escapeHtml(name) + "</td><td>" + mapping::escapeHtml(value) + "</td></tr>\n";
  }
  return html + "</table>\n";
}

std::string changesHtml(const DemoChanges& changes) {
  std::string html =
      "<h2>A second recording</h2>\n<p>Fifteen seconds through the kitchen, later. What has changed is found in the pictures:</p>\n";
  html += "<div class=\"events\">\n";
  for (const DemoEvent& event : changes.events) {
    html += "<figure>";
    html += event.evidence_jpg.empty() ? "" : image(event.evidence_jpg, "jpeg", "what shows it");
    html += "<figcaption>" + mapping::escapeHtml(event.text) + "</figcaption></figure>\n";
  }
  html += "</div>\n<table>\n<tr><th></th><th>before</th><th>after</th></tr>\n";
  for (const AnsweredTwice& one : changes.questions) {
    html += "<tr><td>" + mapping::escapeHtml(one.question) + "</td><td>" + mapping::escapeHtml(one.before) + "</td><td>" +
            mapping::escapeHtml(one.after) + "</td></tr>\n";
  }
  return html + "</table>\n" + image(changes.floor_png, "png", "the map with doors and drawers as they are after it");
}

}  // namespace

std::string toHtml(const DemoPage& page) {
  std::string html = kHead;
  html += "<p>A simulated drive through the apartment, mapped, with what the home knows drawn over the map.</p>\n";
  html += image(page.floor_png, "png", "the map from above with the furniture drawn in");
  html += "<p>Blue: furniture. Red: doors, drawers and knobs. Green: small objects. Purple: the way that the robot drove.</p>\n";
  html += "<h2>Questions</h2>\n" + table(page.questions);
  html += page.later ? changesHtml(*page.later) : "";
  html += "<h2>Figures</h2>\n" + table(page.facts);
  html += "<h2>What the robot saw</h2>\n<div class=\"frames\">\n";
  for (const std::string& frame : page.frames_jpg) {
    html += image(frame, "jpeg", "a frame of the recording");
  }
  return html + "</div>\n<p><a href=\"home/map/report.html\">The map's own report</a></p>\n</body>\n</html>\n";
}

}  // namespace oikos::demo
