"""A Python client of the planning server `nbvopt serve`.

    with PlannerClient("unix:/run/robot/nbvopt") as planner:
        planner.insert_depth_image(depth, Intrinsics(424.0, 424.0, 239.5, 179.5), T_map_sensor)
        plan = planner.plan(base=(1.9, 2.6, 1.57), joints=(0.0, 0.0, 0.4), motion_time_s=1.0)
        print(plan.joints.pan_rad, plan.view.gain)

Frames: map (z up), base (the robot, z up), sensor (optical: z forward, x right, y down). `T_a_b`
takes coordinates in frame b to frame a. Metres, radians and seconds unless a name says otherwise.

Replies are the messages of planner.proto, which documents their fields; `matrix` makes an array of
a pose in them. An argument of the wrong shape or type raises ValueError before anything is sent;
whatever the server refuses raises PlannerError.

Needs grpcio, protobuf, numpy, and the modules that protoc makes of planner.proto.
"""

from __future__ import annotations

import contextlib
import dataclasses
import enum
import pathlib
from typing import Iterable, Iterator, NamedTuple, Optional, Sequence, Tuple, Union

import grpc
import numpy as np

from nbvopt.v1 import planner_pb2 as pb
from nbvopt.v1 import planner_pb2_grpc as rpc

# A rigid transform to the map: a 4 x 4 array, or the protocol's own message.
PoseLike = Union[np.ndarray, pb.Pose]
# T_map_base: a pose, or (x, y, yaw) of a base that stands upright on z = 0.
BaseLike = Union[PoseLike, Sequence[float]]
# (pan, tilt, height) in rad, rad, m, or the protocol's own message, such as a plan's `joints`.
JointsLike = Union[Sequence[float], pb.JointPosition]
# T_map_sensor, or a base with joints.
ViewLike = Union[PoseLike, Tuple[BaseLike, JointsLike]]


class MapFormat(enum.IntEnum):
    """What a map file holds."""

    UNCERTAINTY_OT = pb.MAP_FORMAT_UNCERTAINTY_OT  # occupancy, colour and uncertainty
    BT = pb.MAP_FORMAT_BT  # free and occupied only, for other OctoMap programs
    COLOUR_OT = pb.MAP_FORMAT_COLOUR_OT  # a ColorOcTree, coloured by uncertainty, for octovis
    COLOUR_PLY = pb.MAP_FORMAT_COLOUR_PLY  # a coloured point an occupied voxel


class Intrinsics(NamedTuple):
    """A pinhole camera, in pixels; the centre of the top left pixel is (0, 0)."""

    fx_px: float
    fy_px: float
    cx_px: float
    cy_px: float


@dataclasses.dataclass(frozen=True)
class Tls:
    """PEM files of a connection to another machine."""

    server_ca: pathlib.Path  # signs the server's certificate
    certificate: pathlib.Path  # the client's own
    key: pathlib.Path  # the client's own


class PlannerError(Exception):
    """A call that failed on the server, on the way there or by its timeout.

    `code` tells what to do: RESOURCE_EXHAUSTED to ask again later, DATA_LOSS that the server's disk
    is full or faulty, INVALID_ARGUMENT that the same call will fail again.
    """

    def __init__(self, address: str, code: grpc.StatusCode, message: str):
        super().__init__(f"{address}: {message} ({code.name})")
        self.code = code
        self.message = message


class PlannerClient:
    """A connection, made when it is first needed. Safe to share between threads."""

    def __init__(self, address: str, tls: Optional[Tls] = None, timeout_s: float = 30.0):
        """`address` is HOST:PORT or unix:PATH. A call waits for its answer at most `timeout_s`."""
        self.address = address
        self.timeout_s = timeout_s
        self._channel = _channel(address, tls)
        self._stub = rpc.PlannerStub(self._channel)

    def __enter__(self) -> PlannerClient:
        return self

    def __exit__(self, *error) -> None:
        self.close()

    def close(self) -> None:
        """Ends the connection and all calls in flight."""
        self._channel.close()

    def plan(
        self, base: BaseLike, joints: JointsLike, motion_time_s: float, **options
    ) -> pb.PlanReply:
        """Where should the camera look next? Arguments are those of `plan_request`."""
        request = plan_request(base, joints, motion_time_s, **options)
        return self._call(self._stub.Plan, request)

    def plan_stream(self, requests: Iterable[pb.PlanRequest]) -> Iterator[pb.PlanReply]:
        """Answers states (see `plan_request`) as they come, for as long as there are any.

        The server skips states that a newer one has overtaken: give each a `request_id`, which
        comes back in its answer. `requests` is read by a thread of its own. No timeout holds; to
        end the call early, close this generator.
        """
        yield from self._stream(self._stub.PlanStream, requests)

    def evaluate(
        self, views: Iterable[ViewLike], gain: Optional[str] = None
    ) -> pb.EvaluateReply:
        """What views are worth, in their order: each a T_map_sensor (4 x 4) or (base, joints).

        gain: as in `plan_request`.
        """
        request = pb.EvaluateRequest(views=[_view(view) for view in views], gain=gain)
        return self._call(self._stub.Evaluate, request)

    def insert_depth_image(
        self,
        depth: np.ndarray,
        intrinsics: Intrinsics,
        T_map_sensor: PoseLike,
        depth_scale_m: float = 0.001,
    ) -> pb.InsertScanReply:
        """Inserts a depth image; plans see it when this returns.

        Arguments are those of `depth_image_scan`.
        """
        scan = depth_image_scan(depth, intrinsics, T_map_sensor, depth_scale_m)
        return self._call(self._stub.InsertScan, scan)

    def insert_points(
        self,
        points_m: np.ndarray,
        T_map_sensor: PoseLike,
        colours: Optional[np.ndarray] = None,
        no_returns: Optional[np.ndarray] = None,
    ) -> pb.InsertScanReply:
        """Inserts a point cloud; plans see it when this returns.

        Arguments are those of `point_scan`.
        """
        scan = point_scan(points_m, T_map_sensor, colours, no_returns)
        return self._call(self._stub.InsertScan, scan)

    def insert_scans(self, scans: Iterable[pb.InsertScanRequest]) -> Iterator[pb.InsertScanReply]:
        """Inserts scans (`depth_image_scan`, `point_scan`) in order and acknowledges each.

        `scans` is read by a thread of its own. No timeout holds; to end the call early, close this
        generator. A scan that is refused raises; those that were acknowledged are in the map.
        """
        yield from self._stream(self._stub.InsertScans, scans)

    def load_map(self, path: str) -> pb.LoadMapReply:
        """Replaces the map by that of a file in the server's data folder."""
        return self._call(self._stub.LoadMap, pb.LoadMapRequest(path=path))

    def save_map(
        self, path: str, map_format: MapFormat = MapFormat.UNCERTAINTY_OT
    ) -> pb.SaveMapReply:
        """Writes the map to a file in the server's data folder, whole or not at all."""
        return self._call(self._stub.SaveMap, pb.SaveMapRequest(path=path, format=map_format))

    def get_map(self, map_format: MapFormat = MapFormat.UNCERTAINTY_OT) -> bytes:
        """The map as the bytes of a map file."""
        with self._errors():
            request = pb.GetMapRequest(format=map_format)
            chunks = self._stub.GetMap(request, timeout=self.timeout_s)
            return b"".join(chunk.data for chunk in chunks)

    def clear_map(self, resolution_m: Optional[float] = None) -> pb.ClearMapReply:
        """Replaces the map by an empty one, which keeps its resolution where none is given."""
        return self._call(self._stub.ClearMap, pb.ClearMapRequest(resolution_m=resolution_m))

    def status(self, with_counts: bool = False) -> pb.GetStatusReply:
        """Versions and latencies of the server; `counts` of the map only where asked for."""
        return self._call(self._stub.GetStatus, pb.GetStatusRequest(with_counts=with_counts))

    def _call(self, method, request):
        with self._errors():
            return method(request, timeout=self.timeout_s)

    def _stream(self, method, requests):
        with self._errors():
            answers = method(iter(requests))
            try:
                yield from answers
            finally:
                answers.cancel()  # nothing happens where the stream has ended

    @contextlib.contextmanager
    def _errors(self) -> Iterator[None]:
        try:
            yield
        except grpc.RpcError as error:
            raise PlannerError(self.address, error.code(), error.details()) from None


def plan_request(
    base: BaseLike,
    joints: JointsLike,
    motion_time_s: float,
    *,
    base_twist: Optional[Sequence[float]] = None,
    base_path: Sequence[Tuple[float, BaseLike]] = (),
    search: Union[str, pb.Search, None] = None,
    min_gain: Optional[float] = None,
    seed: Optional[int] = None,
    max_evaluations: Optional[int] = None,
    time_limit_ms: Optional[float] = None,
    certify: Optional[float] = None,
    gain: Optional[str] = None,
    request_id: Optional[int] = None,
) -> pb.PlanRequest:
    """A robot's state, and how to search for its next view.

    base: T_map_base (4 x 4), or (x, y, yaw).
    joints: where they are now, (pan, tilt, height).
    motion_time_s: how long the joints may move; 0 means no limit.
    base_twist: (vx, vy, wz) of the base in its own frame, m/s and rad/s; at rest when not given.
    base_path: where the base will be, (seconds from now, base) each, instead of a twist: the view
        is taken from where the path leads when the motion time is over.
    search: a solver's name, or a Search that composes one; "auto" when not given.
    min_gain: with less to be had the answer is to stay; when not given 1, or 0
        where the robot's gain is neither positive nor expected.
    max_evaluations, time_limit_ms: limits of computing, after which the best so far is answered.
    certify: asks for a bound on what any view in reach gains, and this gap is enough: 0.01, say.
    gain: what views are worth, by name ("expected"), or a sum; the robot's when not given.
    """
    return pb.PlanRequest(
        base=_base(base),
        joints=_joints(joints),
        motion_time_s=motion_time_s,
        base_twist=None if base_twist is None else _base_twist(base_twist),
        base_path=[pb.TimedPose(time_s=time_s, base=_base(pose)) for time_s, pose in base_path],
        search=pb.Search(solver=search) if isinstance(search, str) else search,
        min_gain=min_gain,
        seed=seed,
        max_evaluations=max_evaluations,
        time_limit_ms=time_limit_ms,
        certify=None if certify is None else pb.CertifyOptions(gap=certify),
        gain=gain,
        request_id=request_id,
    )


def depth_image_scan(
    depth: np.ndarray,
    intrinsics: Intrinsics,
    T_map_sensor: PoseLike,
    depth_scale_m: float = 0.001,
) -> pb.InsertScanRequest:
    """A depth image as a scan.

    depth: (height, width) uint16, along the optical axis in units of `depth_scale_m`; 0 is a
    pixel that is not known, 65535 one with nothing in range.
    """
    _check_array("depth", depth, "(height, width)", np.uint16)
    height_px, width_px = depth.shape
    image = pb.DepthImage(
        width_px=width_px,
        height_px=height_px,
        depth=depth.astype("<u2", copy=False).tobytes(),
        depth_scale_m=depth_scale_m,
        **Intrinsics(*intrinsics)._asdict(),
    )
    return pb.InsertScanRequest(sensor=_pose(T_map_sensor, "T_map_sensor"), depth_image=image)


def point_scan(
    points_m: np.ndarray,
    T_map_sensor: PoseLike,
    colours: Optional[np.ndarray] = None,
    no_returns: Optional[np.ndarray] = None,
) -> pb.InsertScanRequest:
    """A point cloud in the sensor frame as a scan.

    points_m: (N, 3) float32, metres; points that are not finite are counted and ignored.
    colours: (N, 3) uint8, red, green and blue.
    no_returns: (M, 3) float32, directions of any length in which nothing is in range.
    """
    cloud = pb.PointCloud(xyz_m=_packed("points_m", points_m))
    if colours is not None:
        _check_array("colours", colours, "(N, 3)", np.uint8)
        if len(colours) != len(points_m):
            raise ValueError(
                f"colours has {len(colours)} rows, points_m {len(points_m)}: give one a point"
            )
        cloud.rgb = colours.tobytes()
    if no_returns is not None:
        cloud.no_return_xyz = _packed("no_returns", no_returns)
    return pb.InsertScanRequest(sensor=_pose(T_map_sensor, "T_map_sensor"), points=cloud)


def matrix(pose: pb.Pose) -> np.ndarray:
    """The 4 x 4 array of a pose in a reply, such as a plan's `sensor`, to the last bit."""
    T = np.eye(4)
    T[:3, :3] = np.reshape(pose.rotation, (3, 3))
    T[:3, 3] = pose.x_m, pose.y_m, pose.z_m
    return T


def _channel(address: str, tls: Optional[Tls]) -> grpc.Channel:
    # What many views are worth may be larger than the 4 MiB that gRPC allows by itself.
    options = [("grpc.max_receive_message_length", -1)]
    if tls is None:
        return grpc.insecure_channel(address, options)
    credentials = grpc.ssl_channel_credentials(
        root_certificates=pathlib.Path(tls.server_ca).read_bytes(),
        private_key=pathlib.Path(tls.key).read_bytes(),
        certificate_chain=pathlib.Path(tls.certificate).read_bytes(),
    )
    return grpc.secure_channel(address, credentials, options)


def _pose(pose: PoseLike, name: str) -> pb.Pose:
    if isinstance(pose, pb.Pose):
        return pose
    T = np.asarray(pose, dtype=float)
    if T.shape != (4, 4):
        raise ValueError(f"{name} has shape {T.shape}, it must be (4, 4)")
    # The last row is not sent: a matrix that is transposed would go unnoticed.
    if not np.array_equal(T[3], [0, 0, 0, 1]):
        raise ValueError(f"{name} ends in the row {T[3].tolist()}, it must be [0, 0, 0, 1]")
    x_m, y_m, z_m = T[:3, 3]
    # A quaternion would round the orientation; the matrix keeps every bit.
    return pb.Pose(x_m=x_m, y_m=y_m, z_m=z_m, rotation=T[:3, :3].ravel())


def _base(base: BaseLike) -> pb.BasePose:
    if not isinstance(base, pb.Pose) and np.shape(base) == (3,):
        x_m, y_m, yaw_rad = base
        return pb.BasePose(planar=pb.PlanarPose(x_m=x_m, y_m=y_m, yaw_rad=yaw_rad))
    if not isinstance(base, pb.Pose) and np.shape(base) != (4, 4):
        raise ValueError(f"base has shape {np.shape(base)}, give (x, y, yaw) or a 4 x 4 T_map_base")
    return pb.BasePose(pose=_pose(base, "base"))


def _joints(joints: JointsLike) -> pb.JointPosition:
    if isinstance(joints, pb.JointPosition):
        return joints
    if np.shape(joints) != (3,):
        raise ValueError(f"joints has shape {np.shape(joints)}, give (pan, tilt, height)")
    pan_rad, tilt_rad, height_m = joints
    return pb.JointPosition(pan_rad=pan_rad, tilt_rad=tilt_rad, height_m=height_m)


def _base_twist(twist: Sequence[float]) -> pb.BaseTwist:
    if np.shape(twist) != (3,):
        raise ValueError(f"base_twist has shape {np.shape(twist)}, give (vx, vy, wz)")
    vx_m_s, vy_m_s, wz_rad_s = twist
    return pb.BaseTwist(vx_m_s=vx_m_s, vy_m_s=vy_m_s, wz_rad_s=wz_rad_s)


def _view(view: ViewLike) -> pb.View:
    if isinstance(view, tuple) and len(view) == 2:
        base, joints = view
        return pb.View(mounted=pb.View.Mounted(base=_base(base), joints=_joints(joints)))
    return pb.View(sensor=_pose(view, "a view's T_map_sensor"))


def _check_array(name: str, array: np.ndarray, shape: str, *dtypes: type) -> None:
    """`shape` is (height, width) or (N, 3). A conversion of numbers would hide a wrong unit."""
    if not isinstance(array, np.ndarray):
        raise ValueError(f"{name} is a {type(array).__name__}, it must be a numpy array")
    if array.ndim != 2 or (shape == "(N, 3)" and array.shape[1] != 3):
        raise ValueError(f"{name} has shape {array.shape}, it must be {shape}")
    if array.dtype.newbyteorder("=") not in [np.dtype(dtype) for dtype in dtypes]:
        wanted = " or ".join(np.dtype(dtype).name for dtype in dtypes)
        raise ValueError(f"{name} holds {array.dtype}, it must hold {wanted}")


def _packed(name: str, xyz: np.ndarray) -> bytes:
    """Records of 3 little-endian float32, as the protocol has them."""
    _check_array(name, xyz, "(N, 3)", np.float32, np.float64)
    return xyz.astype("<f4", copy=False).tobytes()
