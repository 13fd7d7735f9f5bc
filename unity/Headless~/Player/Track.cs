using System;
using System.Collections.Generic;
using System.Globalization;
using System.Linq;
using System.Text.RegularExpressions;
using System.Xml;
using System.Xml.Linq;
using Newtonsoft.Json;
using Newtonsoft.Json.Linq;

namespace Collektive.Headless
{
    /// <summary>The path of a node. It has positions over time, or a single position.</summary>
    public sealed class Track
    {
        private const double EarthRadius = 6371008.8;
        private const int MaxTracks = 1_000_000;
        private const int MaxId = (1 << 24) - 1;

        private readonly List<double> times = new List<double>();
        private readonly List<double> x = new List<double>();
        private readonly List<double> z = new List<double>();
        private int current;

        private Track(int id, int line)
        {
            Id = id;
            Line = line;
        }

        /// <summary>The node's id.</summary>
        public int Id { get; }

        /// <summary>The line of the file in which the track begins.</summary>
        public int Line { get; }

        /// <summary>The times of the points in seconds, increasing; a single NaN without times.</summary>
        public IReadOnlyList<double> Times => times;

        /// <summary>Reads the tracks of a CSV, GeoJSON or GPX file, in the order of the file.</summary>
        /// <param name="isMoving">Whether nodes follow the tracks, so that all positions must have times.</param>
        /// <exception cref="ScenarioException">The file is invalid.</exception>
        public static List<Track> Read(DataFile file, bool isMoving)
        {
            var extension = System.IO.Path.GetExtension(file.Name).ToLowerInvariant();
            var tracks = extension == ".csv" ? FromCsv(file, isMoving) : extension == ".gpx" ? FromGpx(file, isMoving)
                : extension != ".geojson" && extension != ".json" ? throw file.Error(0, "the name must end in .csv, .geojson, .json or .gpx")
                : isMoving ? throw file.Error(0, "GeoJSON has no times: use a CSV or GPX file") : FromGeoJson(file);
            if (tracks.Count > MaxTracks) throw file.Error(0, "the file has " + tracks.Count + " nodes; the maximum is " + MaxTracks);
            return tracks;
        }

        /// <summary>
        /// Returns the position at a time in metres. Between two points, the position is interpolated linearly. Before the first and after the last point, it
        /// is the position of that point.
        /// </summary>
        public void PlaceAt(double time, out float x, out float z)
        {
            // If the time is earlier than in the last call, the search starts again.
            if (times[current] > time) current = 0;
            while (current + 1 < times.Count && times[current + 1] <= time) current++;
            var next = Math.Min(current + 1, times.Count - 1);
            var share = next == current || time <= times[current] ? 0 : (time - times[current]) / (times[next] - times[current]);
            x = (float)(this.x[current] + share * (this.x[next] - this.x[current]));
            z = (float)(this.z[current] + share * (this.z[next] - this.z[current]));
        }

        private void Add(DataFile file, int line, double time, double x, double z)
        {
            if (times.Count > 0 && !(time > times[times.Count - 1]))
            {
                throw file.Error(
                    line, double.IsNaN(time) ? "node " + Id + " is also in line " + Line : "the time must be after that of the previous point of node " + Id);
            }
            if (float.IsInfinity((float)x) || float.IsInfinity((float)z)) throw file.Error(line, "the position is too large");
            times.Add(time);
            this.x.Add(x);
            this.z.Add(z);
        }

        private static List<Track> FromCsv(DataFile file, bool isMoving)
        {
            var tracks = new List<Track>();
            var byId = new Dictionary<int, Track>();
            var rows = file.ReadCsv("id", "x", "z", "lon", "lat", "time");
            var isGeographic = double.IsNaN(rows[0][1]) && !double.IsNaN(rows[0][3]);
            var first = isGeographic ? 3 : 1;
            if (double.IsNaN(rows[0][first]) || double.IsNaN(rows[0][first + 1]))
                throw file.Error(1, "the columns 'x' and 'z', or 'lon' and 'lat', are missing");
            var hasTimes = !double.IsNaN(rows[0][5]);
            if (isMoving && !hasTimes) throw file.Error(1, "the column 'time' is missing");
            if (hasTimes && double.IsNaN(rows[0][0])) throw file.Error(1, "the column 'time' needs the column 'id'");
            foreach (var row in rows)
            {
                var line = (int)row[6];
                var given = double.IsNaN(row[0]) ? tracks.Count : row[0];
                if (!(given >= 0 && given <= MaxId && given == Math.Floor(given)))
                    throw file.Error(line, "'id' is " + given.ToString(CultureInfo.InvariantCulture) + "; it must be a whole number from 0 to " + MaxId);
                if (!byId.TryGetValue((int)given, out var track)) tracks.Add(byId[(int)given] = track = new Track((int)given, line));
                if (isGeographic) RequireGeographic(file, line, row[3], row[4]);
                track.Add(file, line, row[5], row[first], row[first + 1]);
            }
            if (isGeographic) Project(file, tracks);
            return tracks;
        }

        private static List<Track> FromGpx(DataFile file, bool isMoving)
        {
            var tracks = new List<Track>();
            var earliest = double.PositiveInfinity;
            // Seconds since year 1 would be rounded to multiples of 8 microseconds.
            var start = default(DateTimeOffset?);
            try
            {
                XDocument document;
                // From a path, XmlReader would make a URI, in which "%20" is a space.
                using (var stream = System.IO.File.OpenRead(file.Path))
                using (var reader = XmlReader.Create(stream)) document = XDocument.Load(reader, LoadOptions.SetLineInfo);
                foreach (var element in document.Root.Elements())
                {
                    if (element.Name.LocalName != "trk") continue;
                    var track = new Track(tracks.Count, LineOf(element));
                    foreach (var point in element.Descendants())
                    {
                        if (point.Name.LocalName != "trkpt") continue;
                        var line = LineOf(point);
                        var lon = file.Number((string)point.Attribute("lon"), line, "lon");
                        var lat = file.Number((string)point.Attribute("lat"), line, "lat");
                        RequireGeographic(file, line, lon, lat);
                        // If nodes do not follow the tracks, only the first point counts.
                        if (!isMoving && track.times.Count > 0) break;
                        var time = isMoving ? SecondsAfter(ref start, TimeOf(file, point)) : double.NaN;
                        earliest = Math.Min(earliest, time);
                        track.Add(file, line, time, lon, lat);
                    }
                    if (track.times.Count == 0) throw file.Error(track.Line, "the track has no points");
                    tracks.Add(track);
                }
            }
            catch (XmlException error)
            {
                throw file.Error(error.LineNumber, "not valid XML: " + error.Message);
            }
            foreach (var track in tracks)
                for (var i = 0; i < track.times.Count; i++) track.times[i] -= earliest;
            Project(file, tracks);
            return tracks;
        }

        /// <param name="start">The time of the first point; null before it.</param>
        private static double SecondsAfter(ref DateTimeOffset? start, DateTimeOffset time) =>
            (time - (start ??= time)).Ticks / (double)TimeSpan.TicksPerSecond;

        private static DateTimeOffset TimeOf(DataFile file, XElement point)
        {
            foreach (var child in point.Elements())
            {
                if (child.Name.LocalName != "time") continue;
                // Without the pattern, a text without a date would be a time of today, and 03/04/2026 a day in March.
                if (Regex.IsMatch(child.Value, @"^\s*\d{4}-\d\d-\d\dT")
                    && DateTimeOffset.TryParse(child.Value, CultureInfo.InvariantCulture, DateTimeStyles.AssumeUniversal, out var time))
                    return time;
                throw file.Error(LineOf(child), "'time' is '" + child.Value + "'; it must have the form 2026-01-31T12:00:00Z");
            }
            throw file.Error(LineOf(point), "the point has no time");
        }

        private static List<Track> FromGeoJson(DataFile file)
        {
            var tracks = new List<Track>();
            AddPoints(file, JsonFile.Read(file.Path).Root, tracks);
            Project(file, tracks);
            return tracks;
        }

        private static void AddPoints(DataFile file, JToken part, List<Track> tracks)
        {
            var line = (part as IJsonLineInfo)?.LineNumber ?? 0;
            // RFC 7946 removed this member, but some programs still write it.
            if ((part as JObject)?["crs"] is JObject system && !Regex.IsMatch(system.SelectToken("properties.name")?.ToString() ?? "", "(CRS84|:4326)$"))
                throw file.Error(line, "'crs' is not WGS 84: convert the file to longitudes and latitudes of WGS 84");
            switch (((part as JObject)?["type"] as JValue)?.Value as string)
            {
                case "FeatureCollection":
                    foreach (var feature in Items(file, part, "features")) AddPoints(file, feature, tracks);
                    break;
                case "Feature" when part["geometry"] == null || part["geometry"].Type == JTokenType.Null:
                    throw file.Error(line, "the feature has no geometry; remove it, or give it a point");
                case "Feature":
                    AddPoints(file, part["geometry"], tracks);
                    break;
                case "GeometryCollection":
                    foreach (var geometry in Items(file, part, "geometries")) AddPoints(file, geometry, tracks);
                    break;
                case "Point":
                    AddPoint(file, line, part["coordinates"], tracks);
                    break;
                case "MultiPoint":
                    foreach (var point in Items(file, part, "coordinates")) AddPoint(file, line, point, tracks);
                    break;
                default:
                    throw file.Error(line, "'type' is '" + (part as JObject)?["type"] + "': only points are supported, in Feature, FeatureCollection, Point, "
                        + "MultiPoint and GeometryCollection");
            }
        }

        private static JArray Items(DataFile file, JToken part, string key) =>
            part[key] as JArray ?? throw file.Error(((IJsonLineInfo)part).LineNumber, "'" + key + "' must be a list");

        private static void AddPoint(DataFile file, int line, JToken place, List<Track> tracks)
        {
            if (!(place is JArray numbers) || numbers.Count < 2 || !IsNumber(numbers[0]) || !IsNumber(numbers[1]))
                throw file.Error(line, "'coordinates' must be [longitude, latitude]");
            RequireGeographic(file, line, (double)numbers[0], (double)numbers[1]);
            var track = new Track(tracks.Count, line);
            track.Add(file, line, double.NaN, (double)numbers[0], (double)numbers[1]);
            tracks.Add(track);
        }

        private static bool IsNumber(JToken token) => token.Type == JTokenType.Integer || token.Type == JTokenType.Float;

        private static void RequireGeographic(DataFile file, int line, double lon, double lat)
        {
            if (Math.Abs(lon) <= 180 && Math.Abs(lat) <= 90) return;
            throw file.Error(line, "longitude " + lon.ToString(CultureInfo.InvariantCulture) + " and latitude " + lat.ToString(CultureInfo.InvariantCulture)
                + " are out of range; in degrees, they must be from -180 to 180 and from -90 to 90");
        }

        /// <summary>Converts degrees to metres from the centre of all points, by equirectangular projection. x points east, and z north.</summary>
        private static void Project(DataFile file, List<Track> tracks)
        {
            if (tracks.Count == 0) throw file.Error(0, "the file contains no nodes, which are points in GeoJSON and tracks in GPX");
            var longitudes = tracks.SelectMany(track => track.x).Distinct().OrderBy(longitude => longitude).ToList();
            double south = tracks.Min(track => track.z.Min()), north = tracks.Max(track => track.z.Max());
            // The area begins east of the widest gap, so it may continue beyond 180 degrees.
            double west = longitudes[0], east = longitudes[longitudes.Count - 1], gap = west + 360 - east;
            for (var i = 1; i < longitudes.Count; i++)
            {
                if (longitudes[i] - longitudes[i - 1] <= gap) continue;
                gap = longitudes[i] - longitudes[i - 1];
                west = longitudes[i];
                east = longitudes[i - 1] + 360;
            }
            foreach (var track in tracks)
                for (var i = 0; i < track.x.Count; i++) track.x[i] += track.x[i] < west ? 360 : 0;
            const double Radians = Math.PI / 180;
            var metres = EarthRadius * Radians;
            var width = metres * Math.Cos((south + north) / 2 * Radians);
            foreach (var track in tracks)
            {
                for (var i = 0; i < track.x.Count; i++)
                {
                    track.x[i] = width * (track.x[i] - (west + east) / 2);
                    track.z[i] = metres * (track.z[i] - (south + north) / 2);
                }
            }
        }

        private static int LineOf(XObject part) => ((IXmlLineInfo)part).LineNumber;
    }
}
