if (location.protocol === "file:") {
  DOCUMENTATION_OPTIONS.SHOW_SEARCH_SUMMARY = false; // a browser fetches nothing from disk
}

/** Scores of the site's search: the page of a name before all else that bears it. */
var Scorer = {
  score: ([docname, title, , , score]) => {
    const query = new URLSearchParams(window.location.search).get("q") ?? "";
    const page = docname.match(/^generated\/api\/(\w+)$/)?.[1];
    const own = page !== undefined && title.split(".").pop() === page;
    return own && page.toLowerCase() === query.trim().toLowerCase().split(".").pop() ? score + 100 : score;
  },
  // as by default
  objNameMatch: 11,
  objPartialMatch: 6,
  objPrio: { 0: 15, 1: 5, 2: -5 },
  objPrioDefault: 0,
  title: 15,
  partialTitle: 7,
  term: 5,
  partialTerm: 2,
};
