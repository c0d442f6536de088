// Sort a table by the column whose head is clicked; once more turns the order round.
document.querySelectorAll("th").forEach(function (head) {
  head.addEventListener("click", function () {
    var column = head.cellIndex, down = head.dataset.down !== "1";
    head.dataset.down = down ? "1" : "0";
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
