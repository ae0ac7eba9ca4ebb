// Keeps the reader's work in the browser: for this tab, which may be loaded again, and for the next one that is opened.

const STORE = "playground";
const TAB = () => sessionStorage, BROWSER = () => localStorage;  // a browser may forbid even to name them
const MOST = 5e6;  // characters of a scene, for which no browser has room

// Keeps a state under the hash of the address; of all tabs only if it is work, and no sample or stranger's link. Returns whether the next
// tab finds it.
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

// {state, isWork} of this tab before it was loaded again, else of the last one; null if the address has a state of its own. `checked(state)`
// returns a state or throws.
export function kept(checked) {
  for (const store of [TAB, BROWSER]) {
    try {
      const {hash, state, isWork} = JSON.parse(store().getItem(STORE));
      if (hash === location.hash || (store === BROWSER && !location.hash)) return {state: checked(state), isWork};
    } catch { /* nothing, not allowed, or of another version of the page */ }
  }
  return null;
}
