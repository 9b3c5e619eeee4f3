#pragma once

namespace repose::report {

/// The style sheet of the page: light, one column of text, two of cards, fit for print.
inline constexpr const char* kStyle = R"css(
:root { --ink:#22303c; --soft:#5c6975; --line:#e1e5e9; --accent:#b5532a; --paper:#f7f7f5; --card:#ffffff; }
* { box-sizing:border-box; }
body { margin:0; background:var(--paper); color:var(--ink);
  font:16px/1.55 "Helvetica Neue",Helvetica,Arial,"Liberation Sans",sans-serif; }
main { max-width:1120px; margin:0 auto; padding:40px 28px 60px; }
header { margin-bottom:26px; }
h1 { font-size:30px; line-height:1.2; margin:0 0 4px; font-weight:650; letter-spacing:-.01em; }
h2 { font-size:19px; margin:44px 0 14px; font-weight:650; }
h3 { font-size:14px; margin:0 0 8px; font-weight:650; color:var(--soft); }
p { margin:0 0 12px; max-width:70ch; }
sub, sup { font-size:.72em; line-height:0; }
.soft { color:var(--soft); }
.card { background:var(--card); border:1px solid var(--line); border-radius:10px; padding:22px 24px; }
.two { display:grid; grid-template-columns:1fr 1fr; gap:20px; align-items:start; }
.two > * { min-width:0; }
.answer { font-size:34px; line-height:1.25; font-weight:600; margin:0 0 14px; letter-spacing:-.01em; }
.answer .unit { font-weight:400; color:var(--soft); font-size:19px; letter-spacing:0; }
.equation { font:27px/1.4 "STIX Two Text","Cambria Math",Georgia,"Liberation Serif",serif; margin:0 0 14px; }
figure { margin:0; }
figure img { width:100%; height:auto; display:block; }
figcaption { color:var(--soft); font-size:13.5px; line-height:1.45; margin-top:8px; }
.heaps { display:grid; grid-template-columns:repeat(auto-fit,minmax(300px,1fr)); gap:20px; }
table { border-collapse:collapse; width:100%; font-size:14px; font-variant-numeric:tabular-nums; }
th { text-align:left; font-weight:600; color:var(--soft); border-bottom:1px solid #c9d0d6; padding:6px 10px 6px 0; }
td { border-bottom:1px solid var(--line); padding:6px 10px 6px 0; vertical-align:top; }
tr:last-child td { border-bottom:0; }
.number { text-align:right; white-space:nowrap; }
th.number { text-align:right; }
.left-out td { color:var(--accent); }
.facts td:first-child { color:var(--soft); width:52%; }
.note { border-left:3px solid var(--accent); padding:2px 0 2px 14px; margin:0 0 12px; max-width:75ch; }
code { font:13.5px/1.5 "SF Mono",Consolas,"Liberation Mono",monospace; background:#eef1f3; border-radius:5px;
  padding:7px 11px; display:block; margin:0 0 12px; white-space:pre-wrap; overflow-wrap:anywhere; }
summary { cursor:pointer; color:var(--soft); }
.scroll { overflow-x:auto; }
footer { margin-top:44px; color:var(--soft); font-size:13px; border-top:1px solid var(--line); padding-top:14px; }
@media (max-width:860px) { .two { grid-template-columns:1fr; } main { padding:24px 16px; } }
@media print { body { background:#fff; font-size:11pt; } main { max-width:none; padding:0; }
  .card, figure, tr { break-inside:avoid; } .card { border-color:#ccc; } }
)css";

}  // namespace repose::report
