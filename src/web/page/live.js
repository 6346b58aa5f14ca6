// The page of a server: the map as it grows, plans as they come.
"use strict";

const live = {};

/** What the server told last: see LivePage::state(). */
let state = null;
/** The map that is shown, by its id. */
let shownMap = "";

/** Fetches the map into the page's data. */
const fetchMap = async () => {
  const response = await fetch("map");
  if (!response.ok) throw new Error(await response.text());
  const {id, error, map, blocks} = await response.json();
  if (error) throw new Error(error);
  page.data.map = map;
  page.blocks = blocks;
  shownMap = id;
};

/** Fetches what the page shows first. */
live.first = async () => {
  await fetchMap();
  return true;
};

/** Tells how the connection is, and what came last. */
const tell = text => { page.element("live").textContent = text; };
const tellState = () => {
  const isBehind = state.map !== shownMap;
  tell(`live: map version ${state.map_version}${isBehind ? " (is being drawn)" : ""}, `
    + (state.plan === 0 ? "no plan yet" : `plan ${state.plan}`));
};

/** Follows the server for ever: shows the map that is fetched, and answers as they come. */
live.follow = ({showMap, showAnswer}) => {
  const kPause_ms = 500;
  const kPauseAfterError_ms = 5000;
  let isFetching = false;
  let plan = "";
  const keepUp = async () => {
    if (isFetching || state.map === shownMap) return;
    isFetching = true;
    let pause_ms = kPause_ms;
    try {
      await fetchMap();
      await showMap();
      tellState();
    } catch (error) {
      tell("the map cannot be shown: " + error.message);
      pause_ms = kPauseAfterError_ms;
    }
    // There may be a newer one by now; of a map that is long in the making the server gives an
    // older one.
    setTimeout(() => {
      isFetching = false;
      keepUp();
    }, pause_ms);
  };
  const events = new EventSource("events");
  events.addEventListener("state", event => {
    state = JSON.parse(event.data);
    const newest = `${state.map.split("-")[0]}-${state.plan}`;  // of this run of the server
    if (plan !== newest) {
      plan = newest;
      page.data.answer = state.answer;
      page.showParts();
      showAnswer();
    }
    tellState();
    keepUp();
  });
  events.addEventListener("error", () => {
    tell(events.readyState === EventSource.CLOSED
      ? "the server has no place for another page: close one and load this one again"
      : "the server is away, asking again ...");
  });
};
