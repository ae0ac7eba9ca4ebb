// Keeps the reader's work in the browser: for this tab if it is reloaded, and for the next tab that is opened.

const STORE = "playground";
const TAB = () => sessionStorage, BROWSER = () => localStorage;  // functions, since even the names may throw
const MOST = 5e6;  // characters of a scene; browsers have no room for more

// Keeps a state and the hash of the address for this tab and, if the state is the reader's work, not a sample or a link, for other tabs.
// True if other tabs have it, too.
export function keep(state, isWork) {
  if (state.scene.length > MOST) return false;
  const text = JSON.stringify({hash: location.hash, state, isWork});
  for (const store of isWork ? [TAB, BROWSER] : [TAB]) {
    try {
      store().setItem(STORE, text);
    } catch {
      return false;  // no room, or not allowed
    }
  }
  return isWork;
}

// {state, isWork} of this tab before a reload, else of the tab that kept work last; null if there is none, or the address has its own.
// `checked(state)` returns a state or throws.
export function kept(checked) {
  for (const store of [TAB, BROWSER]) {
    try {
      const {hash, state, isWork} = JSON.parse(store().getItem(STORE));
      if (hash === location.hash || (store === BROWSER && !location.hash)) return {state: checked(state), isWork};
    } catch { /* nothing, not allowed, or of another version of the page */ }
  }
  return null;
}
