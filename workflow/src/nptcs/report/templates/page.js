// The page works without any of this: sorting of tables, light or dark, marking the current section.
(function () {
  var root = document.documentElement, button = document.getElementById("theme");
  function show(theme) {
    if (theme) root.dataset.theme = theme; else delete root.dataset.theme;
    button.textContent = { "": button.dataset.auto, light: button.dataset.light, dark: button.dataset.dark }[theme];
  }
  if (button) {
    button.hidden = false;
    show(["light", "dark"].includes(root.dataset.theme) ? root.dataset.theme : "");
    button.addEventListener("click", function () {
      var order = ["", "dark", "light"], next = order[(order.indexOf(root.dataset.theme || "") + 1) % 3];
      show(next);
      try { localStorage.setItem("nptcs-theme", next); } catch (refused) { /* no storage */ }
    });
  }

  // sort a table by the column whose heading is clicked; a second click reverses the order
  document.querySelectorAll("thead th").forEach(function (head) {
    var sorter = document.createElement("button");
    sorter.type = "button";
    while (head.firstChild) sorter.appendChild(head.firstChild);
    head.appendChild(sorter);
    sorter.addEventListener("click", function () {
      var column = head.cellIndex, down = head.getAttribute("aria-sort") !== "ascending";
      head.parentNode.querySelectorAll("th[aria-sort]").forEach(function (other) { other.removeAttribute("aria-sort"); });
      head.setAttribute("aria-sort", down ? "ascending" : "descending");
      var body = head.closest("table").tBodies[0];
      var key = function (row) {
        var cell = row.cells[column];
        return cell.dataset.n === undefined ? cell.textContent : Number(cell.dataset.n);
      };
      Array.from(body.rows)
        .sort(function (a, b) {
          var x = key(a), y = key(b);
          var order = typeof x === "number" && typeof y === "number" ? x - y : String(x).localeCompare(String(y));
          return down ? order : -order;
        })
        .forEach(function (row) { body.appendChild(row); });
    });
  });

  // mark the section being read, and close the menu when one is chosen
  var links = {};
  document.querySelectorAll("nav a").forEach(function (link) {
    var name = link.getAttribute("href").slice(1);
    (links[name] = links[name] || []).push(link);
    link.addEventListener("click", function () {
      var menu = link.closest("details");
      if (menu) menu.open = false;
    });
  });
  var seen = new Set();
  var watcher = new IntersectionObserver(function (entries) {
    entries.forEach(function (entry) { if (entry.isIntersecting) seen.add(entry.target.id); else seen.delete(entry.target.id); });
    var now = Object.keys(links).find(function (name) { return seen.has(name); });
    Object.keys(links).forEach(function (name) {
      links[name].forEach(function (link) {
        if (name === now) link.setAttribute("aria-current", "location"); else link.removeAttribute("aria-current");
      });
    });
  }, { rootMargin: "-60px 0px -60% 0px" });
  document.querySelectorAll("main > section").forEach(function (section) { watcher.observe(section); });
})();
