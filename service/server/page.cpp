#include "gridcull/service/server/page.h"

namespace gridcull {

#ifdef GRIDCULL_WITH_PAGE

/// Made from service/page by the build; ends with a null pointer.
extern const char* const page_pieces[];

std::string page_text() {
  static const std::string text = [] {
    std::string joined;
    for (const char* const* piece = page_pieces; *piece; ++piece) joined += *piece;
    return joined;
  }();
  return text;
}

#else

std::string page_text() {
  return R"(<!doctype html>
<html lang="en"><meta charset="utf-8"><title>gridcull</title>
<style>body{font:16px/1.4 system-ui,sans-serif;margin:2rem;max-width:60rem}td,th{padding:.2rem .8rem;text-align:left}</style>
<h1>gridcull</h1>
<p>Sessions on this server. Clients talk to it at <code>/v1/stream</code>; <a href="/metrics">metrics</a>.</p>
<table><thead><tr><th>session<th>name<th>method<th>objects<th>viewers<th>frames<th>client</thead><tbody id="list"></tbody></table>
<script>
async function show() {
  const { sessions } = await (await fetch("/v1/sessions")).json();
  const list = document.getElementById("list");
  list.replaceChildren(...sessions.map((s) => {
    const row = document.createElement("tr");
    for (const v of [s.session, s.name, s.method, s.objects, s.viewers, s.seq, s.connected ? "here" : "away"]) {
      row.insertCell().textContent = v;
    }
    return row;
  }));
}
show();
setInterval(show, 1000);
</script>
)";
}

#endif

}  // namespace gridcull
