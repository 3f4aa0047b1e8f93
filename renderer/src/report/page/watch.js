// Before anything else runs: what goes wrong is kept, for the self-test.
window.problems = [];
window.addEventListener("error", (event) => window.problems.push(String(event.message || event.target?.outerHTML)), true);
window.addEventListener("unhandledrejection", (event) => window.problems.push(String(event.reason)));
