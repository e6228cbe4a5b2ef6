// SPDX-License-Identifier: Apache-2.0
#include "mapping/report/style_sheet.h"

namespace oikos::mapping {

std::string_view reportStyleSheet() {
  return R"css(
:root { color-scheme: light dark;
  --ground: #f4f5f7; --card: #ffffff; --ink: #18202b; --soft: #5b6675; --rule: #e1e5ea; --rule-strong: #c4cbd4;
  --after: #0b7a6f; --before: #d9822b; --loop: #6554c0; --lost: #c9372c; --good: #1f845a; --care: #b65c02; --carried: #e0a100; --found: #388bff; }
@media (prefers-color-scheme: dark) { :root {
  --ground: #10141a; --card: #181e26; --ink: #e4e9f0; --soft: #98a4b3; --rule: #2a323d; --rule-strong: #465161;
  --after: #37c2ae; --before: #f0a355; --loop: #a99cf5; --lost: #f87168; --good: #4bce97; --care: #fea362; --carried: #f5cd47; --found: #85b8ff; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--ink);
  font: 15px/1.5 system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", "DejaVu Sans", sans-serif; font-variant-numeric: tabular-nums; }
main { max-width: 1020px; margin: 0 auto; padding: 28px 20px 48px; }
h1 { font-size: 15px; font-weight: 600; letter-spacing: .02em; color: var(--soft); margin: 0 0 12px; }
h2 { font-size: 17px; margin: 0 0 12px; }
p { margin: 0 0 8px; }
section { background: var(--card); border: 1px solid var(--rule); border-radius: 12px; padding: 20px 22px; margin: 0 0 16px; }
.verdict { border-left: 6px solid var(--good); }
.verdict.usable-with-care { border-left-color: var(--care); }
.verdict.not-usable { border-left-color: var(--lost); }
.verdict h2 { font-size: 26px; line-height: 1.2; margin-bottom: 8px; }
.verdict ul { list-style: none; margin: 12px 0 0; padding: 0; }
.verdict li { padding: 6px 0 6px 24px; position: relative; }
.verdict li::before { content: ""; position: absolute; left: 3px; top: 13px; width: 9px; height: 9px; border-radius: 50%; background: var(--rule-strong); }
.verdict li.usable-with-care::before { background: var(--care); }
.verdict li.not-usable::before { background: var(--lost); }
.advice { color: var(--soft); }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(140px, 1fr)); gap: 12px; margin: 0 0 16px; }
.figure { background: var(--card); border: 1px solid var(--rule); border-radius: 12px; padding: 12px 16px; }
.figure b { display: block; font-size: 23px; font-weight: 650; line-height: 1.25; white-space: nowrap; }
.figure span { color: var(--soft); font-size: 13px; }
.legend { display: flex; flex-wrap: wrap; gap: 4px 18px; color: var(--soft); font-size: 13px; margin: 8px 0 0; }
.legend i { display: inline-block; width: 18px; height: 0; border-top: 3px solid; margin-right: 6px; vertical-align: middle; }
.legend i.dash { border-top-style: dashed; border-top-width: 2px; }
.legend i.box { height: 10px; width: 10px; border: 0; border-radius: 2px; }
.legend i.dot { border-radius: 50%; }
.key-after { color: var(--after); } .key-before { color: var(--before); } .key-loop { color: var(--loop); } .key-earlier { color: var(--rule-strong); } .key-plan { color: var(--found); } .key-refused { color: var(--soft); }
.key-new { background: var(--found); } .key-gone { background: var(--care); }
.key-start { background: var(--good); } .key-end { background: var(--lost); }
.key-tracked { background: var(--good); } .key-relocalised { background: var(--found); }
.key-carried { background: var(--carried); } .key-lost { background: var(--lost); }
.key-occupied { background: #647080; } .key-free { background: rgba(138, 148, 160, .35); }
svg { display: block; width: 100%; height: auto; }
svg path, svg line { fill: none; vector-effect: non-scaling-stroke; stroke-linejoin: round; stroke-linecap: round; }
.map { border-radius: 8px; background: var(--ground); }
.grid { image-rendering: pixelated; }
.after { stroke: var(--after); stroke-width: 2.5; } .before { stroke: var(--before); stroke-width: 1.8; opacity: .85; }
.plan { stroke: var(--found); stroke-width: 1.2; } .loop { stroke: var(--loop); stroke-width: 1.4; opacity: .75; } .refused { stroke: var(--soft); stroke-width: 1.2; stroke-dasharray: 4 4; }
.earlier { stroke: var(--rule-strong); stroke-width: 1.8; }
.change-new { fill: var(--found); fill-opacity: .25; stroke: var(--found); } .change-gone { fill: var(--care); fill-opacity: .25; stroke: var(--care); stroke-dasharray: 4 3; }
.keyframes { stroke: var(--after); stroke-width: 4.5; }
.start { fill: var(--good); stroke: var(--card); stroke-width: 2; } .end { fill: var(--lost); stroke: var(--card); stroke-width: 2; }
.scale { stroke: var(--ink); stroke-width: 1.5; }
.scale-text { font-size: 15px; text-anchor: middle; fill: var(--ink); }
.plot { margin: 0 0 14px; }
.plot .rule { stroke: var(--rule); stroke-width: 1; }
.plot text { font-size: 13px; fill: var(--soft); }
.tick-y { text-anchor: end; } .tick-x { text-anchor: middle; }
.plot .band { fill: currentColor; opacity: .18; } .plot .line { stroke: currentColor; stroke-width: 1.6; }
.plot .inliers { color: var(--after); } .plot .residual { color: var(--loop); }
rect.tracked { fill: var(--good); opacity: .45; } rect.relocalised { fill: var(--found); } rect.carried { fill: var(--carried); } rect.lost { fill: var(--lost); }
.scroll { overflow-x: auto; }
table + table { margin-top: 14px; }
table { border-collapse: collapse; width: 100%; font-size: 14px; }
th, td { text-align: left; padding: 6px 14px 6px 0; border-bottom: 1px solid var(--rule); vertical-align: top; }
th { color: var(--soft); font-weight: 500; }
td.number, th.number { text-align: right; }
td.number { white-space: nowrap; }
td:last-child, th:last-child { padding-right: 0; }
tr:last-child th, tr:last-child td { border-bottom: 0; }
td.text { overflow-wrap: anywhere; padding-left: 12px; }
td.text:first-child { padding-left: 0; }
th + th:not(.number) { padding-left: 12px; }
.columns { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(380px, 100%), 1fr)); gap: 16px; }
.columns section { margin: 0; }
.columns { margin: 0 0 16px; }
.note { color: var(--soft); font-size: 13px; margin: 10px 0 0; }
@media (max-width: 640px) { .plot text { font-size: 22px; } .scale-text { font-size: 26px; } section { padding: 16px; } }
@media print {
  :root { color-scheme: light; --ground: #ffffff; --card: #ffffff; --ink: #000000; --soft: #444444; --rule: #cccccc; --rule-strong: #999999;
    --after: #0b7a6f; --before: #d9822b; --loop: #6554c0; --lost: #c9372c; --good: #1f845a; --care: #b65c02; --carried: #e0a100; --found: #388bff; }
  body { font-size: 11px; } main { max-width: none; padding: 0; }
  section, .figure { break-inside: avoid; border-radius: 6px; } section { padding: 12px 14px; margin-bottom: 10px; }
  * { print-color-adjust: exact; -webkit-print-color-adjust: exact; } }
)css";
}

}  // namespace oikos::mapping
