namespace UnityEditor
{
    public class FileUtil
    {
        /// Resolves a path below `Packages` to the package manager's folder. Returns other paths unchanged.
        public static string GetPhysicalPath(string path) => Headless.Project.PhysicalPath(path);
    }
}
