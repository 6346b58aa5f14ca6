// The page of a server: the map as it grows, plans as they come.
"use strict";

const live = {};

/** What the server told last: see LivePage::state(). */
let state = null;
/** The map that is shown, by its id. */
let shownMap = "";
/** Is told of each state. */
let onState = () => {};

/** Tells how the connection is, and what came last. */
const tell = text => { page.element("live").textContent = text; };

const listen = () => {
  const events = new EventSource("events");
  events.addEventListener("state", event => {
    state = JSON.parse(event.data);
    onState();
  });
  events.addEventListener("error", () => {
    tell(events.readyState === EventSource.CLOSED
      ? "the server has no place for another page: close one and load this one again"
      : "the server is away, asking again ...");
  });
};

/** Fetches what changed of the map since the one that is shown, all at first: {bricks, isWhole}. */
const fetchMap = async () => {
  const response = await fetch("map?since=" + encodeURIComponent(shownMap));
  if (!response.ok) throw new Error(await response.text());
  const {id, error, map, bricks, is_whole: isWhole} = await response.json();
  if (error) throw new Error(error);
  page.data.map = map;
  return {id, bricks, isWhole};
};

/** Shows the newest map: fetches what `put(bricks, isWhole)` puts in place. */
live.update = async put => {
  const {id, bricks, isWhole} = await fetchMap();
  await put(bricks, isWhole);
  shownMap = id;
};

/** Shows the first map; the server knows from then on that somebody follows it. */
live.first = async put => {
  listen();
  await live.update(put);
};

const tellState = () => {
  const isBehind = state.map !== shownMap;
  tell(`live: map version ${state.map_version}${isBehind ? " (is being drawn)" : ""}, `
    + (state.plan === 0 ? "no plan yet" : `plan ${state.plan}`));
};

/** Follows the server for ever: puts what changed into the map, and shows answers as they come. */
live.follow = ({putBricks, showAnswer}) => {
  const kPause_ms = 100;
  const kPauseAfterError_ms = 5000;
  let isFetching = false;
  let plan = "";
  const keepUp = async () => {
    if (isFetching || state.map === shownMap) return;
    isFetching = true;
    let pause_ms = kPause_ms;
    try {
      await live.update(putBricks);
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
  onState = () => {
    const newest = `${state.map.split("-")[0]}-${state.plan}`;  // of this run of the server
    if (plan !== newest) {
      plan = newest;
      page.data.answer = state.answer;
      page.showParts();
      showAnswer();
    }
    tellState();
    keepUp();
  };
  if (state) onState();
};
